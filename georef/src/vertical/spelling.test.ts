import { describe, expect, it } from "vitest";
import { similarSystems } from "./spelling.js";
import type { VerticalSystem } from "./systems.js";

const system = (code: number, name: string, area: VerticalSystem["area"], depth = false): VerticalSystem => ({
  ...{ code, name, area, depth, countries: [], partners: [], unit: { name: "metre", size: 1 } },
});
const NETHERLANDS = [2.5, 50.7, 7.3, 55.8] as const;
const AMERICA = [172, 14, -66, 72] as const;
const GERMANY = [5.8, 47.2, 15.1, 55.1] as const;
const SYSTEMS = [
  system(5703, "NAVD88 height", AMERICA),
  system(6360, "NAVD88 height (ftUS)", AMERICA),
  system(5709, "NAP height", NETHERLANDS),
  system(5710, "NAP depth", NETHERLANDS, true),
  system(5783, "DHHN92 height", GERMANY),
  system(7837, "DHHN2016 height", GERMANY),
  system(5773, "EGM96 height", [-180, -90, 180, 90]),
];
const UTRECHT = { longitude: 5.1, latitude: 52.1 };
const BERLIN = { longitude: 13.4, latitude: 52.5 };
const codes = (text: string, place?: typeof UTRECHT) =>
  similarSystems(SYSTEMS, text, place).map(({ code }) => code);

describe("similarSystems", () => {
  it.each([
    ["a word of the name", "nap", UTRECHT, [5709]],
    ["the whole name, wherever it is", "DHHN2016 height", UTRECHT, [7837]],
    ["a bare code", "5709", undefined, [5709]],
    ["the beginning, at the place", "DHHN", BERLIN, [5783, 7837]],
    ["a slip of the pen", "DHNN92", BERLIN, [5783]],
    ["without a place, all of them", "NAVD88", undefined, [5703, 6360]],
    ["of the whole world", "EGM96", BERLIN, [5773]],
  ] as const)("finds %s", (_, text, place, expected) => {
    expect(codes(text, place)).toEqual(expected);
  });

  it.each([
    ["another country's for a few letters", "NAVD", UTRECHT],
    ["short texts that are alike by chance", "NPA", UTRECHT],
    ["nothing", "  ", UTRECHT],
    ["other words", "sea level", UTRECHT],
  ])("does not take %s", (_, text, place) => {
    expect(codes(text, place)).toEqual([]);
  });
});

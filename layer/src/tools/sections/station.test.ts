import { expect, it } from "vitest";
import { stations, stationText } from "./station.js";

it("stations are the ends of the line, round multiples of the interval, and those given, each once", () => {
  expect(stations(103.5, 125, { interval: 5, at: [110, 111.25] })).toEqual([
    103.5, 105, 110, 111.25, 115, 120, 125,
  ]);
  expect(stations(-3, 3, { interval: 2 })).toEqual([-3, -2, 0, 2, 3]);
  expect(stations(0, 0.3, { interval: 0.1 })).toEqual([0, 0.1, 0.2, 0.3]);
  expect(stations(0, 10, { at: [7, 2] })).toEqual([2, 7]);
});

it("an end of the line may be given as it is printed, with two decimals or more", () => {
  const [from, to] = [-0.12345, 223.60679774997897];
  for (const printed of [223.61, 223.607, 223.6068])
    expect(stations(from, to, { at: [printed] })).toEqual([to]);
  expect(stations(from, to, { at: [-0.1235, -0.12345, 223.6] })).toEqual([from, 223.6]);
  for (const beyond of [223.608, 223.611, 223.62, 224, -0.124])
    expect(() => stations(from, to, { at: [beyond] })).toThrow(
      `the line has no chainage ${beyond}: it is -0.12345 to 223.60679774997897`,
    );
});

it.each([
  [{ interval: 0 }, "the interval cannot be 0"],
  [{ interval: Number.NaN }, "the interval cannot be NaN"],
  [{ interval: 1e-9 }, "1e-9 is too small an interval"],
  [{ at: [11] }, "the line has no chainage 11: it is 0 to 10"],
  [{}, "neither an interval nor a station is given"],
])("%j is refused", (options, message) => {
  expect(() => stations(0, 10, options)).toThrow(message);
});

it("chainages are written with thousands before the sign", () => {
  expect(stationText(1250)).toBe("1+250.00");
  expect(stationText(999.999)).toBe("1+000.00");
  expect(stationText(12.3456, 3)).toBe("0+012.346");
  expect(stationText(-1250.5, 1)).toBe("-1+250.5");
  expect(stationText(-0.001)).toBe("0+000.00");
  expect(stationText(1234.6, 0)).toBe("1+235");
});

import { describe, expect, it } from "vitest";
import { ASPRS_CLASSES } from "./declaration/classes.js";
import { GRADIENTS } from "./declaration/gradients.js";
import { styleOf } from "./scene.fixture.js";
import { cloud, complete, stop } from "./style.fixture.js";
import { defaultStyle } from "./style.js";

describe("a style in parts", () => {
  it("keeps what is not given, and what is undefined", () => {
    const base = styleOf({ color: "elevation", range: [1, 2] });
    expect(complete({ pointSize: 5 }, base)).toEqual({ ...base, pointSize: 5 });
    expect(complete({ pointSize: undefined, gamma: undefined }, base)).toEqual(base);
  });

  it("takes back a range and a blend", () => {
    const base = styleOf({ range: [1, 2], blend: { color: "intensity", share: 0.5 } });
    expect(complete({ range: undefined, blend: undefined }, base)).toEqual(styleOf());
    expect(complete({ pointSize: 3 }, base).range).toEqual([1, 2]);
  });

  it("completes Eye-Dome Lighting from the numbers that stand, else from the defaults", () => {
    const numbers = { strength: 0.4, radius: 2, neighbours: 4 } as const;
    for (const before of [true, false, "auto"] as const) {
      const style = complete({ eyeDomeLighting: { radius: 2 } }, styleOf({ eyeDomeLighting: before }));
      expect(style.eyeDomeLighting).toEqual(numbers);
    }
    const base = styleOf({ eyeDomeLighting: { strength: 1, radius: 9, neighbours: 8 } });
    expect(complete({ eyeDomeLighting: { radius: 2 } }, base).eyeDomeLighting).toEqual({
      strength: 1,
      radius: 2,
      neighbours: 8,
    });
    expect(complete({ eyeDomeLighting: {} }).eyeDomeLighting).toEqual({ ...numbers, radius: 1.4 });
  });

  it("completes a highlight and a blend", () => {
    expect(complete({ highlight: { share: 1 } }).highlight).toEqual({ color: [1, 0, 0], share: 1 });
    expect(complete({ highlight: { color: [0, 0, 1] } }).highlight).toEqual({ color: [0, 0, 1], share: 0.6 });
    expect(complete({ blend: { color: "intensity" } }).blend).toEqual({ color: "intensity", share: 0.5 });
    const base = styleOf({ blend: { color: "intensity", share: 0.2 } });
    expect(complete({ blend: { share: 0.9 } }, base).blend).toEqual({ color: "intensity", share: 0.9 });
    expect(complete({ blend: { color: "gpsTime" } }, base).blend).toEqual({ color: "gpsTime", share: 0.2 });
  });

  it("edits single classes", () => {
    const once = complete({ classes: { 6: { show: false }, 64: { name: "vines", color: [0, 1, 0] } } });
    expect(once.classes[6]).toEqual({ ...ASPRS_CLASSES[6], show: false });
    expect(once.classes[64]).toEqual({ name: "vines", color: [0, 1, 0], show: true });
    expect(once.classes[2]).toBe(ASPRS_CLASSES[2]);
    const twice = complete({ classes: { 6: { color: [0, 0, 0] }, 64: undefined } }, once);
    expect(twice.classes[6]).toEqual({ name: "Building", color: [0, 0, 0], show: false });
    expect(twice.classes[64]).toEqual(once.classes[64]);
    expect(Object.keys(twice.classes)).toHaveLength(256);
  });
});

// Before any style has frozen what it holds.
const SHARED_BEFORE = [ASPRS_CLASSES, ASPRS_CLASSES[6], ASPRS_CLASSES[6].color].map((one) =>
  Object.isFrozen(one),
);

describe("what is shared", () => {
  it("is frozen by itself: the classes of ASPRS before a style holds them", () => {
    expect(SHARED_BEFORE).toEqual([true, true, true]);
  });

  const whole = {
    gradient: [stop(0), stop(1)],
    range: [0, 1],
    blend: { color: "intensity", share: 0.5 },
    classes: { 6: { color: [0, 0, 1] } },
    eyeDomeLighting: { radius: 3 },
    highlight: { color: [0, 0, 1] },
  };

  /** All objects in a value. */
  const objectsIn = (value: unknown): object[] =>
    typeof value === "object" && value !== null ? [value, ...Object.values(value).flatMap(objectsIn)] : [];

  it.each<[string, unknown]>([
    ["the default style", defaultStyle(cloud)],
    ["a style that was given", complete(whole)],
    ["the classes of ASPRS", ASPRS_CLASSES],
    ["the gradients", GRADIENTS],
  ])("is frozen: %s", (_, value) => {
    const all = objectsIn(value);
    expect(all.length).toBeGreaterThan(10);
    expect(all.filter((one) => !Object.isFrozen(one))).toEqual([]);
  });

  it("is nothing of the caller's", () => {
    const given = structuredClone(whole);
    const style = complete(given);
    const theirs = new Set(objectsIn(given));
    expect(objectsIn(style).filter((one) => theirs.has(one))).toEqual([]);
    expect([...theirs].filter((one) => Object.isFrozen(one))).toEqual([]);
  });
});

import { describe, expect, it } from "vitest";
import { nodeUniforms } from "../effect-plan.js";
import { planEffects } from "../plan.js";
import { richFacts, styleOf } from "../scene.fixture.js";
import type { ClassStyle } from "./classes.js";
import { ASPRS_CLASSES } from "./classes.js";
import { checkFilter, type PointFilter, recordTest } from "./filter.js";

/** Whether a record of some values passes; values are stored as they are, or as steps of a thousandth. */
function passesFilter(
  record: Readonly<Record<string, unknown>>,
  filter: PointFilter,
  style: ClassStyle | undefined,
  step = 0,
): boolean {
  const numbersOf = (name: string) =>
    Object.hasOwn(record, name) ? { value: () => Number(record[name]), step } : undefined;
  return recordTest(filter, style, numbersOf)(0);
}

describe("filters on exact records", () => {
  const filter: PointFilter = { returns: ["intermediate", "single"], ranges: { gpsTime: [10, 20] } };
  it.each<[Record<string, number>, boolean]>([
    [{ classification: 2, returnNumber: 2, numberOfReturns: 3, gpsTime: 10 }, true],
    [{ classification: 2, returnNumber: 1, numberOfReturns: 1, gpsTime: 20 }, true],
    [{ classification: 2, returnNumber: 1, numberOfReturns: 2, gpsTime: 15 }, false],
    [{ classification: 2, returnNumber: 2, numberOfReturns: 2, gpsTime: 15 }, false],
    [{ classification: 2, returnNumber: 2, numberOfReturns: 3, gpsTime: 20.000001 }, false],
    [{ classification: 7, returnNumber: 2, numberOfReturns: 3, gpsTime: 15 }, false],
    [{ classification: 2, returnNumber: 2, numberOfReturns: 3 }, false],
  ])("%j: %s", (record, passes) => {
    const classes = { ...ASPRS_CLASSES, 7: { ...ASPRS_CLASSES[7], show: false } };
    expect(passesFilter(record, filter, { classes })).toBe(passes);
  });
});

it("takes in what lies at a bound but for the rounding of float64, where integers are stored", () => {
  const filter = { ranges: { height: [0.1, 0.7] as const } };
  expect(70 * 0.01).toBeGreaterThan(0.7);
  expect(passesFilter({ height: 70 * 0.01 }, filter, undefined, 0.01)).toBe(true);
  expect(passesFilter({ height: 71 * 0.01 }, filter, undefined, 0.01)).toBe(false);
  expect(passesFilter({ height: 70 * 0.01 }, filter, undefined)).toBe(false);
});

describe("a filter that is given", () => {
  const attributes = [
    ...richFacts().attributes,
    { name: "__proto__", kind: "scalar" },
    { name: "constructor", kind: "scalar" },
    { name: "normals", kind: "scalar", components: 3 },
  ] as const;
  const check = (filter: unknown) => checkFilter(filter as PointFilter, { attributes, name: "a.copc.laz" });

  it("is taken as it is, copied and frozen", () => {
    const given = {
      classes: [2, 6],
      returns: ["last"],
      ranges: { intensity: [1, 1], gpsTime: [0, Infinity] },
    };
    const filter = check(given);
    expect(filter).toEqual(given);
    for (const part of [filter, filter.classes, filter.returns, filter.ranges, filter.ranges?.gpsTime]) {
      expect(Object.isFrozen(part)).toBe(true);
    }
    expect(Object.isFrozen(given.classes)).toBe(false);
    expect(check({})).toEqual({});
    expect(check({ classes: undefined, ranges: { intensity: undefined } })).toEqual({ ranges: {} });
  });

  it.each<[unknown, string]>([
    [{ classes: [256] }, "filter.classes[0] cannot be 256. Use a whole number from 0 to 255"],
    [{ classes: [2, 1.5] }, "filter.classes[1] cannot be 1.5"],
    [{ classes: 2 }, "filter.classes cannot be 2. Use an array"],
    [{ returns: ["third"] }, 'filter.returns[0] cannot be "third"'],
    [{ returns: ["fisrt"] }, 'Did you mean "first"? Otherwise use first, last, intermediate or single'],
    [{ returns: ["constructor"] }, 'filter.returns[0] cannot be "constructor"'],
    [{ ranges: { heat: [0, 1] } }, 'filter.ranges has no "heat". Use elevation, intensity'],
    [{ ranges: { intensty: [0, 1] } }, 'Did you mean "intensity"?'],
    [{ ranges: { rgb: [0, 1] } }, 'filter.ranges has no "rgb"'],
    [{ ranges: { normals: [0, 1] } }, 'filter.ranges has no "normals"'],
    [{ ranges: { toString: [0, 1] } }, 'filter.ranges has no "toString"'],
    [{ ranges: { intensity: [5, 1] } }, "filter.ranges.intensity cannot run from 5 to 1"],
    [{ ranges: { intensity: [Number.NaN, 1] } }, "filter.ranges.intensity cannot run from NaN to 1"],
    [{ ranges: { intensity: 5 } }, "filter.ranges.intensity cannot be 5"],
    [{ range: {} }, 'Did you mean "ranges"? Otherwise use classes, returns or ranges'],
    [[], "filter cannot be an empty array"],
    ["last", 'filter cannot be "last"'],
  ])("is STYLE_FILTER for %j", (filter, words) => {
    expect(() => check(filter)).toThrow(
      expect.objectContaining({ code: "STYLE_FILTER", file: "a.copc.laz" }),
    );
    expect(() => check(filter)).toThrow(words);
  });

  it("may name an attribute as prototypes do, and holds records against it", () => {
    const filter = check(JSON.parse('{ "ranges": { "__proto__": [1, 2], "constructor": [3, 4] } }'));
    expect(Object.keys(filter.ranges ?? {})).toEqual(["__proto__", "constructor"]);
    const classes = ASPRS_CLASSES;
    const record = (text: string) => JSON.parse(text) as Record<string, number>;
    expect(passesFilter(record('{ "__proto__": 1, "constructor": 3 }'), filter, { classes })).toBe(true);
    expect(passesFilter(record('{ "__proto__": 1, "constructor": 5 }'), filter, { classes })).toBe(false);
    expect(passesFilter({}, filter, { classes })).toBe(false);
    // What all objects inherit is no value of a record, though it can be read as a number.
    const inherited: Record<string, unknown> = Object.create({ constructor: 3, __proto__: null });
    const one = check({ ranges: { constructor: [3, 4] } });
    expect(passesFilter(inherited, one, { classes })).toBe(false);
  });

  it("has bounds that float32 holds, however open it is", () => {
    const filter = check({ ranges: { intensity: [-Infinity, Infinity], gpsTime: [5, Infinity] } });
    const plan = planEffects(styleOf(), richFacts({ filter }));
    const node = {
      ...{ columns: { get: () => ({ scale: -2, offset: 1 }) }, level: 0, spacing: 1, toCube: [] },
    };
    const bounds = nodeUniforms(plan, node);
    expect(bounds.u_range0).toEqual([-3e38, 3e38]);
    expect(bounds.u_range1).toEqual([-3e38, -2 + 1e-6]);
    for (const bound of [bounds.u_range0, bounds.u_range1].flat()) {
      expect(Number.isFinite(Math.fround(Number(bound)))).toBe(true);
    }
  });
});

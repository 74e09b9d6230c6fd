import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { commonScale, formOf } from "./form.js";
import type { Dimension, Probe } from "./probe.js";

type Three = readonly [number, number, number];

function probe(min: Three, max: Three, more: Partial<Probe> = {}): Probe {
  return {
    ...{ job: { name: "a.e57", stages: [] }, points: 1, min, max, dimensions: [], wkt: "" },
    ...{ streamed: true, readers: ["readers.e57"] },
    ...more,
  };
}

const dimension = (name: string, type: Dimension["type"], size: number, min = 0, max = 1): Dimension => {
  return { name, type, size, min, max };
};

describe("the scale of what PDAL reads", () => {
  it("is a tenth of a millimetre, finer for small objects, coarser only where integers would not suffice", () => {
    expect(commonScale([probe([2.6e6, 1.2e6, 400], [2.601e6, 1.201e6, 500])], false).scale).toEqual([
      1e-4, 1e-4, 1e-4,
    ]);
    expect(commonScale([probe([-1, -2, 0], [1, 2, 0.5])], false).scale).toEqual([1e-6, 1e-6, 1e-7]);
    expect(commonScale([probe([0, 0, 0], [1e6, 1e6, 100])], false).scale[0]).toBe(1e-3);
    expect(commonScale([probe([7, 46, 400], [8, 47, 500])], true).scale).toEqual([1e-9, 1e-9, 1e-4]);
  });

  it("fits the integers of LAS for every extent, and offsets are whole numbers", () => {
    const number = fc.double({ min: -1e9, max: 1e9, noNaN: true });
    fc.assert(
      fc.property(fc.tuple(number, number, number), fc.tuple(number, number, number), (a, b) => {
        const min = a.map((value, axis) => Math.min(value, b[axis]!)) as unknown as Three;
        const max = a.map((value, axis) => Math.max(value, b[axis]!)) as unknown as Three;
        const { scale, offset } = commonScale([probe(min, max)], false);
        for (const axis of [0, 1, 2] as const) {
          for (const value of [min[axis], max[axis]]) {
            expect(Math.abs(Math.round((value - offset[axis]) / scale[axis]))).toBeLessThan(2 ** 31);
          }
          expect(Number.isInteger(offset[axis])).toBe(true);
        }
      }),
    );
  });

  it("is one for all inputs", () => {
    const { offset } = commonScale([probe([0, 0, 0], [1, 1, 1]), probe([-500, 0, 0], [1, 1, 1])], false);
    expect(offset).toEqual([-500, 0, 0]);
  });

  it("stays that of LAS where all inputs agree and their coordinates are left alone", () => {
    const stored = { scale: [0.01, 0.01, 0.01], offset: [1000, 2000, 0] } as const;
    expect(commonScale([probe([1000, 2000, 0], [1001, 2001, 1], { stored })], false)).toEqual(stored);
    const mixed = [probe([0, 0, 0], [1, 1, 1], { stored }), probe([0, 0, 0], [1, 1, 1])];
    expect(commonScale(mixed, false).scale).not.toEqual(stored.scale);
  });

  it("is the one that was asked for, or refused by name", () => {
    expect(commonScale([probe([0, 0, 0], [10, 10, 10])], false, 0.001).scale).toEqual([0.001, 0.001, 0.001]);
    const degrees = commonScale([probe([7, 46, 400], [8, 47, 500])], true, 1e-8);
    expect(degrees.scale).toEqual([1e-8, 1e-8, 1e-4]);
    expect(() => commonScale([probe([0, 0, 0], [1e6, 1, 1])], false, 1e-6)).toThrow(
      /^PDAL_SCALE: a\.e57: .*--scale/,
    );
  });
});

describe("the record of what PDAL reads", () => {
  const { scale, offset } = commonScale([probe([0, 0, 0], [1, 1, 1])], false);
  const formed = (...dimensions: Dimension[]) =>
    formOf(probe([0, 0, 0], [1, 1, 1], { dimensions }), { scale, offset });

  it("has room for colours, near infrared and extra dimensions", () => {
    expect(formed().pointFormat).toBe(6);
    const colours = ["Red", "Green", "Blue"].map((name) => dimension(name, "unsigned", 2, 0, 65535));
    expect(formed(...colours).pointFormat).toBe(7);
    const whole = formed(...colours, dimension("Infrared", "unsigned", 2), dimension("Range", "floating", 4));
    expect(whole).toMatchObject({ pointFormat: 8, recordLength: 38 + 4, keptAside: [], rounded: [] });
  });

  it("keeps aside what LAS's fields cannot hold, and tells what becomes whole numbers", () => {
    expect(formed(dimension("Intensity", "floating", 4, 0, 0.8)).keptAside).toEqual(["Intensity"]);
    expect(formed(dimension("Intensity", "signed", 4, -1000, 10)).keptAside).toEqual(["Intensity"]);
    expect(formed(dimension("Intensity", "unsigned", 2, 0, 65535)).keptAside).toEqual([]);
    expect(formed(dimension("Red", "floating", 8, 0, 255))).toMatchObject({
      keptAside: [],
      rounded: ["Red"],
    });
    expect(formed(dimension("GpsTime", "floating", 8, -5, 1e9))).toMatchObject({
      keptAside: [],
      rounded: [],
    });
    expect(formed(dimension("Intensity", "floating", 4, 0, 0.8)).recordLength).toBe(30 + 8);
  });
});

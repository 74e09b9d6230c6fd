import { exactTransform, pointTransform, resolveCrs } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { Clip, ClipSet } from "../../clips/index.js";
import { BoxVolume } from "./box-volume.js";
import { ClippedVolume } from "./clipped-volume.js";
import { PolygonVolume } from "./polygon-volume.js";

const [X, Y] = [500_000, 5_200_000];
const given = "+proj=utm +zone=32 +datum=WGS84 +units=m";
const transform = pointTransform(
  exactTransform(resolveCrs({ file: "a", given, givenVertical: "ellipsoidal" })),
);
const space = {
  boundingBox: { min: [X, Y, 400], max: [X + 1000, Y + 1000, 500] } as const,
  place: (x: number, y: number, z: number, out: Float64Array) => {
    transform(x, y, z, out, 0);
    return out;
  },
};

const along = fc.double({ min: -50, max: 1050, noNaN: true });
const up = fc.double({ min: 380, max: 520, noNaN: true });
const whole = fc.integer({ min: -50, max: 1050 });
const mode = fc.constantFrom("inside" as const, "outside" as const, "highlight" as const);
const at = fc.tuple(along, along, up).map(([x, y, z]) => ({ source: [X + x, Y + y, z] as const }));
const angle = fc.double({ min: -3, max: 3, noNaN: true });
const length = fc.double({ min: 10, max: 800, noNaN: true });
const box = fc
  .record({ center: at, size: fc.tuple(length, length, length), mode, heading: angle, pitch: angle })
  .map(Clip.box);
const plane = fc.record({ through: at, mode, heading: angle, pitch: angle }).map(Clip.plane);
const polygon = fc
  .tuple(
    fc.uniqueArray(fc.tuple(whole, whole), { minLength: 3, maxLength: 6, selector: String }),
    mode,
    up,
    fc.boolean(),
  )
  .map(([ring, how, bottom, ends]) =>
    Clip.polygon(
      ring.map(([x, y]) => [X + x, Y + y] as const),
      { mode: how, coordinates: "source", ...(ends && { bottom, top: bottom + 30 }) },
    ),
  );

describe("what clips leave of a data set", () => {
  it("has the points that picks and drawing keep, and boxes never say otherwise", () => {
    let crossed = 0;
    fc.assert(
      fc.property(
        fc.array(fc.oneof(box, plane, polygon), { minLength: 1, maxLength: 4 }),
        fc.array(fc.tuple(along, along, up), { minLength: 20, maxLength: 20 }),
        fc.double({ min: 1, max: 300, noNaN: true }),
        (clips, points, edge) => {
          const set = new ClipSet(clips);
          const volume = ClippedVolume.over(set, space);
          const kept = set.over(space);
          for (const [x, y, z] of points) {
            // Off all edges, which only one of both takes for inside.
            const [px, py] = [X + x + Math.PI / 10, Y + y + Math.E / 10];
            const inside = volume.contains(px, py, z);
            expect(inside).toBe(kept.keeps(space.place(px, py, z, new Float64Array(3)), [px, py, z]));
            const low = [px - edge / 3, py - edge / 2, z - edge / 4];
            const relation = volume.toBox(Float64Array.from([...low, ...low.map((value) => value + edge)]));
            if (relation === "crossing") crossed++;
            else expect(inside).toBe(relation === "in");
          }
        },
      ),
      { numRuns: 150 },
    );
    expect(crossed).toBeGreaterThan(100);
  });

  it("is a part of another volume, and of polygons in source coordinates has the edges", () => {
    const ring = [
      [X + 0.1, Y + 0.3],
      [X + 300.1, Y + 100.3],
      [X + 0.1, Y + 100.3],
    ] as const;
    const clip = Clip.polygon(ring, { coordinates: "source" });
    const exact = new PolygonVolume([ring]);
    const volume = ClippedVolume.over([clip], space);
    for (let step = 0; step < 300; step++) {
      const [x, y] = [X + 0.1 + step, Y + 0.3 + step / 3];
      expect(volume.contains(x, y, 0)).toBe(exact.contains(x, y));
    }
    const part = ClippedVolume.over([clip], space, new BoxVolume([X, Y, 0], [X + 10, Y + 100, 50]));
    expect([part.contains(X + 5, Y + 90, 10), part.contains(X + 20, Y + 90, 10)]).toEqual([true, false]);
    expect(part.toBox(Float64Array.of(X + 20, Y + 80, 0, X + 30, Y + 90, 9))).toBe("out");
  });

  it("is everything where nothing cuts", () => {
    const volume = ClippedVolume.over(
      [Clip.box({ center: { source: [X, Y, 0] }, size: [1, 1, 1], mode: "highlight" })],
      space,
    );
    expect(volume.toBox(Float64Array.of(0, 0, 0, 1, 1, 1))).toBe("in");
  });
});

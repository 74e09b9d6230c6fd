import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { ecefToGeodetic } from "../ellipsoid/ecef-to-geodetic.js";
import { placePoint, type Similarity, similarityTransform } from "../engines/truth.js";
import { RecordError } from "../errors/errors.js";
import { decodeRecord, encodeRecord } from "../record/record.js";
import { type Anchor, anchorSimilarity } from "./anchor.js";
import { type ControlPoint, fitSimilarity } from "./fit.js";
import { localCrs } from "./local-crs.js";

const DEGREE = Math.PI / 180;

function ecef(similarity: Similarity, point: readonly [number, number, number]): Float64Array {
  const out = new Float64Array(3);
  placePoint(similarityTransform(similarity), ...point, out);
  return out;
}

/** Points with the places that a similarity gives them. */
function controls(
  similarity: Similarity,
  points: readonly (readonly [number, number, number])[],
): ControlPoint[] {
  return points.map((source) => {
    const geodetic = new Float64Array(3);
    ecefToGeodetic(...(ecef(similarity, source) as unknown as [number, number, number]), geodetic);
    return { source, geodetic: [geodetic[0], geodetic[1], geodetic[2]] };
  });
}

const apart = (a: Float64Array, b: Float64Array) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

const anchors: fc.Arbitrary<Anchor> = fc.record({
  longitude: fc.double({ min: -Math.PI, max: Math.PI, noNaN: true }),
  latitude: fc.double({ min: -Math.PI / 2, max: Math.PI / 2, noNaN: true }),
  height: fc.double({ min: -500, max: 9000, noNaN: true }),
  heading: fc.double({ min: -7, max: 7, noNaN: true }),
  scale: fc.double({ min: 0.01, max: 100, noNaN: true }),
  at: fc.tuple(...[0, 1, 2].map(() => fc.double({ min: -1000, max: 1000, noNaN: true }))) as fc.Arbitrary<
    [number, number, number]
  >,
});

describe("an anchor", () => {
  it("has its point at its place, and is a rotation times its scale, everywhere", () => {
    fc.assert(
      fc.property(anchors, (anchor) => {
        const { translation, matrix } = anchorSimilarity(anchor);
        const [{ geodetic }] = controls({ translation, matrix }, [anchor.at]);
        expect(Math.abs(geodetic[1] - anchor.latitude)).toBeLessThan(1e-13);
        expect(Math.abs(geodetic[2] - anchor.height)).toBeLessThan(1e-7);
        for (let i = 0; i < 3; i++) {
          for (let j = 0; j < 3; j++) {
            const dot = [0, 3, 6].reduce((sum, row) => sum + matrix[row + i] * matrix[row + j], 0);
            expect(Math.abs(dot / anchor.scale ** 2 - (i === j ? 1 : 0))).toBeLessThan(1e-14);
          }
        }
      }),
    );
  });

  it("looks north at heading 0 and east at 90°", () => {
    const anchor = { longitude: 0, latitude: 0, height: 0, scale: 2, at: [0, 0, 0] as const };
    const end = (heading: number) => ecef(anchorSimilarity({ ...anchor, heading }), [0, 10, 0]);
    expect([...end(0)].map(Math.round)).toEqual([6378137, 0, 20]);
    expect([...end(90 * DEGREE)].map(Math.round)).toEqual([6378137, 20, 0]);
  });
});

describe("control points", () => {
  const shapes: Record<string, [number, number, number][]> = {
    "three points": [
      [0, 0, 0],
      [40, 3, 1],
      [7, 25, -2],
    ],
    "a plane": [
      [0, 0, 5],
      [30, 0, 5],
      [30, 20, 5],
      [0, 20, 5],
    ],
    "a cube far from the origin": [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [
      ...([5e5 + 10 * (i & 1), 4e6 + 5 * (i & 2), 300 + 2.5 * (i & 4)] as const),
    ]),
  };

  it.each(Object.entries(shapes))("on %s bring a similarity back within 1 µm", (_, points) => {
    fc.assert(
      fc.property(anchors, (anchor) => {
        const at = points[0];
        const known = anchorSimilarity({ ...anchor, at });
        const { similarity, scale, max } = fitSimilarity(controls(known, points), "control.txt");
        expect(max).toBeLessThan(1e-6);
        expect(Math.abs(scale / anchor.scale - 1)).toBeLessThan(1e-7 / anchor.scale);
        for (const point of points)
          expect(apart(ecef(similarity, point), ecef(known, point))).toBeLessThan(1e-6);
      }),
      { numRuns: 200 },
    );
  });

  it("that contradict each other share the misfit, and its size is told", () => {
    const known = anchorSimilarity({
      longitude: 1,
      latitude: 0.8,
      height: 0,
      heading: 2,
      scale: 1,
      at: [0, 0, 0],
    });
    const points = controls(known, shapes["a plane"]);
    const [longitude, latitude, height] = points[2].geodetic;
    const moved = points.with(2, { ...points[2], geodetic: [longitude, latitude, height + 0.04] });
    const { rms, max, residuals } = fitSimilarity(moved, "control.txt");
    expect(residuals.every((residual) => Math.abs(residual - 0.01) < 1e-4)).toBe(true);
    expect(rms).toBeCloseTo(0.01, 4);
    expect(max).toBe(Math.max(...residuals));
  });
});

describe("the record of a similarity", () => {
  const crs = localCrs("local coordinates", 0.5);
  const similarity = anchorSimilarity({
    longitude: 1,
    latitude: 1,
    height: 1,
    heading: 1,
    scale: 0.5,
    at: [1, 2, 3],
  });
  const record = {
    version: 1,
    crs,
    engine: { name: "similarity", version: "1" },
    similarity,
    accuracy: [],
  } as const;

  it("comes back as it was written", () => {
    expect(decodeRecord(encodeRecord(record), "scan")).toEqual(record);
  });

  it("is refused with a matrix of eight numbers", () => {
    const short = { ...record, similarity: { ...similarity, matrix: similarity.matrix.slice(1) } };
    expect(() => decodeRecord(encodeRecord(short), "scan")).toThrow(RecordError);
  });
});

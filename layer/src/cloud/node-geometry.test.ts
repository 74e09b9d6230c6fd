import { exactTransform, pointTransform, resolveCrs } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { type GeometrySource, NodeGeometry } from "./node-geometry.js";

/** A data set's geometry, with its map. */
function geometryOf(
  given: string,
  corner: readonly [number, number],
  edge: number,
  heights: [number, number],
) {
  const crs = resolveCrs({ file: "a", given, givenVertical: "ellipsoidal" });
  const truth = exactTransform(crs);
  const [x, y] = corner;
  const boundingBox: GeometrySource["boundingBox"] = {
    min: [x, y, heights[0]],
    max: [x + edge, y + edge, heights[1]],
  };
  const source: GeometrySource = { boundingBox, cube: [x, y, heights[0], edge], spacing: edge / 128 };
  return { geometry: new NodeGeometry(source, truth, crs), place: pointTransform(truth), boundingBox };
}

const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
const FEET =
  "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +y_0=0 +ellps=GRS80 +towgs84=0,0,0 +units=ft";
const DEGREES = "+proj=longlat +ellps=WGS84 +towgs84=0,0,0";

describe("NodeGeometry", () => {
  it.each([
    ["a country in metres", geometryOf(UTM, [450_000, 5_200_000], 102_400, [0, 3000])],
    ["a town in feet", geometryOf(FEET, [635_000, 848_000], 20_000, [400, 900])],
    ["degrees", geometryOf(DEGREES, [8, 47], 1, [0, 0.01])],
    ["a plane", geometryOf(UTM, [450_000, 5_200_000], 1000, [7, 7])],
  ])(
    "has spheres around all points of a node, hardly larger than needed: %s",
    (_, { geometry, place, boundingBox }) => {
      const unit = fc.double({ min: 0, max: 1, noNaN: true });
      const node = fc.integer({ min: 0, max: 12 }).chain((depth) =>
        fc.record({
          depth: fc.constant(depth),
          x: fc.integer({ min: 0, max: 2 ** depth - 1 }),
          y: fc.integer({ min: 0, max: 2 ** depth - 1 }),
        }),
      );
      fc.assert(
        fc.property(
          node,
          fc.array(fc.tuple(unit, unit, unit), { minLength: 1, maxLength: 8 }),
          (key, points) => {
            const bounds = geometry.bounds({ ...key, z: 0 })!;
            const [x, y, z, edge] = geometry.cube({ ...key, z: 0 });
            const low = [x, y, z].map((from, axis) => Math.max(from, boundingBox.min[axis]));
            const high = [x, y, z].map((from, axis) => Math.min(from + edge, boundingBox.max[axis]));
            const out = new Float64Array(3);
            const at = (parts: readonly number[]) => {
              const [px, py, pz] = parts.map((part, axis) => low[axis] + part * (high[axis] - low[axis]));
              place(px, py, pz, out, 0);
              return [...out];
            };
            for (const parts of points) {
              const [px, py, pz] = at(parts);
              const away = Math.hypot(px - bounds.x, py - bounds.y, pz - bounds.z);
              expect(away).toBeLessThanOrEqual(bounds.radius * (1 + 1e-9));
            }
            const [a, b] = [at([0, 0, 0]), at([1, 1, 1])];
            const diagonal = Math.hypot(...a.map((value, axis) => value - b[axis]));
            expect(bounds.radius).toBeLessThan(0.5 * diagonal * 1.2 + 1e-3);
          },
        ),
      );
    },
  );

  it("knows between which heights the data lie", () => {
    const { geometry } = geometryOf(UTM, [450_000, 5_200_000], 1000, [100, 250]);
    expect(geometry.heights.map((height) => Math.round(height * 1e6) / 1e6)).toEqual([100, 250]);
  });
});

import { Cartesian3, Matrix4, Transforms } from "cesium";
import fc from "fast-check";
import { expect, it } from "vitest";
import type { NodeVertices } from "../workers/index.js";
import { pointsNear } from "./points-near.js";

const origin = Cartesian3.fromDegrees(7, 50, 100);
const modelMatrix = Transforms.eastNorthUpToFixedFrame(origin);
const metres = fc.double({ min: -20, max: 20, noNaN: true });
const point = fc.tuple(metres, metres, metres);
const placeOf = (at: readonly [number, number, number]) =>
  Matrix4.multiplyByPoint(modelMatrix, new Cartesian3(...at), new Cartesian3());

/** A node of so many points, as it lies on the GPU. */
const node = (points: readonly (readonly [number, number, number])[]) => ({
  modelMatrix,
  sphere: { center: origin, radius: 35 } as never,
  vertices: { positions: Float32Array.from(points.flat()) } as unknown as NodeVertices,
});

it("are all points within the radius, where they are drawn", () => {
  fc.assert(
    fc.property(fc.array(fc.array(point, { maxLength: 20 }), { maxLength: 4 }), point, (nodes, at) => {
      const place = placeOf(at);
      const away = (one: Cartesian3) => Cartesian3.distance(one, place);
      const near = nodes.flat().map(placeOf);
      // Vertices are float32: what lies on the edge may be on either side of it.
      if (near.some((one) => Math.abs(away(one) - 10) < 1e-4)) return;
      const wanted = near.filter((one) => away(one) < 10);
      const found = pointsNear(place, 10, nodes.map(node));
      expect(found.length).toBe(3 * wanted.length);
      for (const [index, one] of wanted.entries()) {
        expect(Cartesian3.distance(one, Cartesian3.unpack(found, 3 * index))).toBeLessThan(1e-5);
      }
    }),
  );
});

import { eastNorthUp, geodeticToEcef } from "@groma/georef";
import { Cartesian3, Matrix4, Transforms } from "cesium";
import { describe, expect, it } from "vitest";
import type { DrawnVertices } from "../drawing/drawn-vertices.js";
import type { VertexPages } from "../drawing/vertex-pages.js";
import type { CesiumTypes } from "./engine/gpu-objects.js";
import { matrixOf, NodeDrawable, NodePlaces, PLACE, writeToEye } from "./node-drawable.js";

describe("matrixOf", () => {
  it("takes the node frame to ECEF without losing a nanometre", () => {
    const origin = new Float64Array(3);
    geodeticToEcef(0.15, 0.82, 500, origin);
    const frame = eastNorthUp(origin);
    const matrix = matrixOf({ frame });
    const [east, north, up] = [12.5, -7.25, 3];
    const point = Matrix4.multiplyByPoint(matrix, new Cartesian3(east, north, up), new Cartesian3());
    const expected = [0, 1, 2].map(
      (axis) =>
        origin[axis] +
        frame.rotation[axis] * east +
        frame.rotation[axis + 3] * north +
        frame.rotation[axis + 6] * up,
    );
    for (const [axis, value] of [point.x, point.y, point.z].entries()) {
      expect(Math.abs(value - expected[axis])).toBeLessThan(2e-9);
    }
  });

  it("adds a height offset along the node's own up, and nothing sideways", () => {
    const origin = new Float64Array(3);
    const higher = new Float64Array(3);
    geodeticToEcef(-1.2, 0.4, 30, origin);
    geodeticToEcef(-1.2, 0.4, 55.5, higher);
    const frame = eastNorthUp(origin);
    const lifted = matrixOf({ frame }, 25.5);
    const { x, y, z } = Matrix4.getTranslation(lifted, new Cartesian3());
    for (const [axis, value] of [x, y, z].entries()) expect(value).toBeCloseTo(higher[axis], 7);
    const turned = (matrix: Matrix4) => Matrix4.toArray(matrix).slice(0, 12);
    expect(turned(lifted)).toEqual(turned(matrixOf({ frame })));
  });

  it("puts up where the ellipsoid's normal points", () => {
    const origin = new Float64Array(3);
    geodeticToEcef(0, Math.PI / 2, 0, origin);
    const up = Matrix4.multiplyByPointAsVector(
      matrixOf({ frame: eastNorthUp(origin) }),
      Cartesian3.UNIT_Z,
      new Cartesian3(),
    );
    expect([up.x, up.y, up.z].map((value) => Math.round(value * 1e12) / 1e12)).toEqual([0, 0, 1]);
  });
});

it("writes what takes stored positions to the eye, rounded once, in rows", () => {
  const origin = new Float64Array(3);
  geodeticToEcef(0.15, 0.82, 500, origin);
  const frame = eastNorthUp(origin);
  const vertices = { frame, box: [0, 0, 0, 1, 1, 1], columns: new Map(), step: 2 ** -10 };
  const places = new NodePlaces();
  const nodeOf = (slot: number, heightOffset: number) =>
    new NodeDrawable(
      {} as VertexPages<CesiumTypes>,
      vertices as unknown as DrawnVertices,
      slot,
      places,
      heightOffset,
    );
  const node = nodeOf(3, 7);
  // Room for more is made without losing it.
  nodeOf(40, 9);
  const eye = Cartesian3.fromRadians(0.1501, 0.8201, 900);
  const view = Matrix4.inverseTransformation(Transforms.eastNorthUpToFixedFrame(eye), new Matrix4());
  const table = new Float32Array(20).fill(9);
  writeToEye(Matrix4.toArray(view), places.numbers, places.begin(node.slot) + PLACE.toGlobe, table, 4);
  const product = Matrix4.multiplyTransformation(view, matrixOf({ frame }, 7), new Matrix4());
  const steps = Matrix4.multiplyByUniformScale(product, 2 ** -10, new Matrix4());
  const rows = Matrix4.toArray(Matrix4.transpose(steps, new Matrix4())).slice(0, 12).map(Math.fround);
  expect([...table]).toEqual([...Array(4).fill(9), ...rows, ...Array(4).fill(9)]);
});

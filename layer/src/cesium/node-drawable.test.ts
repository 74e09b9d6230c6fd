import { eastNorthUp, geodeticToEcef } from "@groma/georef";
import { Cartesian3, Matrix4 } from "cesium";
import { describe, expect, it } from "vitest";
import { matrixOf } from "./node-drawable.js";

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

import { describe, expect, it } from "vitest";
import { runPipeline } from "./cct.js";
import { compose, helmertMap, IDENTITY, isIdentity, type LinearMap } from "./helmert.js";
import { findProj } from "./program/find.js";
import { splitPipeline } from "./step-text.js";

const proj = await findProj();
const absent = proj ? "" : " (skipped: PROJ is not installed)";
const POINT = [3903453.1, 368135.3, 5012970.3];

function apply({ translation, matrix }: LinearMap, [x, y, z]: readonly number[]): number[] {
  return [0, 1, 2].map(
    (i) => translation[i] + matrix[3 * i] * x + matrix[3 * i + 1] * y + matrix[3 * i + 2] * z,
  );
}

const FULL = "+x=565.7381 +y=50.4018 +z=465.2904 +rx=0.395 +ry=-0.331 +rz=1.876 +s=4.07244";

describe.skipIf(!proj)(`the linear map of a shift${absent}`, () => {
  it.each([
    "+proj=helmert +x=674.374 +y=15.056 +z=405.346",
    "+proj=helmert +s=12.5",
    `+proj=helmert ${FULL} +convention=coordinate_frame`,
    `+proj=helmert ${FULL} +convention=position_vector`,
    "+proj=helmert +x=1 +rx=3000 +ry=-2000 +rz=9000 +s=10 +convention=position_vector +exact",
    "+proj=helmert +x=1 +rx=3000 +ry=-2000 +rz=9000 +s=10 +convention=coordinate_frame +exact",
    `+proj=molobadekas ${FULL} +px=2464351.59 +py=-5783466.61 +pz=974809.81 +convention=coordinate_frame`,
  ])("is PROJ's own: %s", async (text) => {
    for (const inverse of [false, true]) {
      const step = { ...splitPipeline(text)[0], inverse };
      const truth = await runPipeline(proj!, [step], Float64Array.from(POINT));
      const own = apply(helmertMap(step), POINT);
      const apart = Math.hypot(...own.map((value, i) => value - truth[i]));
      expect(apart, inverse ? "inverse" : "forward").toBeLessThan(1e-8);
    }
  });
});

describe("linear maps", () => {
  it("compose in order", () => {
    const [first, second] = ["+x=1 +s=5", "+y=2 +rz=3 +convention=position_vector"].map((text) =>
      helmertMap(splitPipeline(`+proj=helmert ${text}`)[0]),
    );
    const [x, y, z] = apply(compose(first, second), POINT);
    const [u, v, w] = apply(second, apply(first, POINT));
    expect(Math.hypot(x - u, y - v, z - w)).toBeLessThan(1e-8);
    expect(isIdentity(compose(IDENTITY, IDENTITY))).toBe(true);
  });

  it.each(["+rx=1", "+rx=1 +convention=other", "+x=", "+x=1e999", "+theta=3", "+dx=1"])(
    "of unclear parameters are refused: %s",
    (text) => {
      expect(() => helmertMap(splitPipeline(`+proj=helmert ${text}`)[0])).toThrow(
        expect.objectContaining({ code: "CRS_OPERATION_UNSUPPORTED" }),
      );
    },
  );
});

import { describe, expect, it } from "vitest";
import { distance } from "../cartesian/points.fixture.js";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  aroundPoints,
  type Domain,
  exactTransform,
  fitPlacement,
  geodeticToEcef,
  placeIntegers,
  resolveCrs,
} from "../index.js";

const DEGREE = Math.PI / 180;
const SCALE = [1e-7, 1e-7, 1e-3];
const OFFSET = [0, 0, 0];
const exact = exactTransform(
  resolveCrs({ file: "scan", given: "EPSG:4326", givenVertical: "ellipsoidal" }, lookup),
);

/** Points of a degree on both sides of 180°, whose longitudes lie a turn apart. */
const xyz = Int32Array.from({ length: 300 }, (_, i) => {
  const share = ((i * 0.754877666) % 1) * 0.05;
  if (i % 3 === 0) return Math.round(1e7 * (i % 2 === 0 ? 180 - share : -180 + share));
  return i % 3 === 1 ? Math.round(1e7 * (-17 + share)) : i;
});
const domain: Domain = { minX: -180, minY: -17, minZ: 0, maxX: 180, maxY: -16.95, maxZ: 0.3 };

/** Greatest distance of stored points from where they are, metres. */
function worst(placement: ReturnType<typeof fitPlacement>): number {
  const out = new Float32Array(300);
  placeIntegers(placement, xyz, 100, SCALE, OFFSET, out);
  const { origin, rotation } = placement.frame;
  const [there, place] = [new Float64Array(3), new Float64Array(3)];
  let greatest = 0;
  for (let i = 0; i < 300; i += 3) {
    const at = [0, 1, 2].map((axis) => xyz[i + axis] * SCALE[axis]);
    geodeticToEcef(at[0] * DEGREE, at[1] * DEGREE, at[2], there);
    for (let axis = 0; axis < 3; axis++) {
      place[axis] =
        origin[axis] +
        rotation[axis] * out[i] +
        rotation[3 + axis] * out[i + 1] +
        rotation[6 + axis] * out[i + 2];
    }
    greatest = Math.max(greatest, distance(place, there));
  }
  return greatest;
}

describe("a frame amid the points", () => {
  it("draws both sides of 180° to 1 mm, which the middle of their longitudes cannot", () => {
    const fitted = fitPlacement(exact, domain, 1e-3);
    expect(fitted.scheme).toBe("exact");
    expect(worst(fitted)).toBeGreaterThan(0.01);
    expect(worst(fitted)).toBeLessThanOrEqual(fitted.bound);
    const amid = aroundPoints(fitted, { xyz, count: 100 }, SCALE, OFFSET, 1e-3);
    expect(amid.bound).toBeLessThanOrEqual(1e-3);
    expect(worst(amid)).toBeLessThanOrEqual(amid.bound);
  });

  it("leaves alone what is placed well as it is", () => {
    const node = { ...domain, minX: 7, maxX: 7.01 };
    const fitted = fitPlacement(exact, node, 1e-3);
    expect(aroundPoints(fitted, { xyz, count: 100 }, SCALE, OFFSET, 1e-3)).toBe(fitted);
    const wide = fitPlacement(exact, domain, 1e-3);
    expect(aroundPoints(wide, { xyz, count: 0 }, SCALE, OFFSET, 1e-3)).toBe(wide);
  });
});

import { describe, expect, it } from "vitest";
import { eastNorthUp } from "../ellipsoid/frame.js";
import { type GridStep, linkOf } from "../transformation/compile.js";
import { chanceSteps } from "./chance-grids.fixture.js";
import { type DirectionFit, fitDirections } from "./directions.js";
import { boxOf } from "./expansion.js";
import { NodeSamples } from "./node-samples.js";

const EDGE = 3000;
const domain = { minX: 497e3, minY: 5089e3, minZ: 0, maxX: 497e3 + EDGE, maxY: 5089e3 + EDGE, maxZ: 800 };

/** Directions of a grid without values, over a node of 3 km, and the axes east, north and up at its middle. */
function fitted(shift: "forward" | "inverse" | undefined): { fit: DirectionFit; axes: Float64Array[] } {
  const steps = chanceSteps(0, 1, { shift, heights: shift === undefined });
  const samples = new NodeSamples(boxOf(domain));
  const links = steps.map((step) => linkOf(step));
  samples.apply(links[0]);
  const flat = (_: number, __: number, out: Float64Array) => void out.fill(0);
  const fit = fitDirections(steps[1] as GridStep, flat, links.slice(1), samples, samples.snapshot());
  const middle = Float64Array.of(domain.minX + EDGE / 2, domain.minY + EDGE / 2, 400);
  for (const link of links) link.apply(middle);
  const { rotation } = eastNorthUp([...middle]);
  return { fit, axes: [0, 3, 6].map((from) => Float64Array.from(rotation.subarray(from, from + 3))) };
}

const dot = (a: ArrayLike<number>, b: ArrayLike<number>) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const vector = (of: Float64Array, c: number) => of.subarray(3 * c, 3 * c + 3);

describe("how a value of a grid moves points", () => {
  it("is up for heights, turning with the earth's curvature", () => {
    const { fit, axes } = fitted(undefined);
    const [east, north, up] = axes;
    expect(dot(vector(fit.centre, 0), up)).toBeCloseTo(1, 8);
    // Over half the edge up turns by that over the radius, 6,370 to 6,390 km here, to the east and to the north.
    const turn = EDGE / 2 / 6.38e6;
    expect(dot(vector(fit.byU, 0), east) / turn).toBeCloseTo(1, 2);
    expect(dot(vector(fit.byV, 0), north) / turn).toBeCloseTo(1, 2);
    // What that leaves is of second order, doubled: 2 · (turn² + turn²) / 2 or so.
    expect(fit.error[0]).toBeGreaterThan(turn ** 2 / 2);
    expect(fit.error[0]).toBeLessThan(6 * turn ** 2);
    expect(fit.greatest[0]).toBeCloseTo(1, 6);
    expect([fit.greatest.length, fit.error.length]).toEqual([1, 1]);
  });

  it.each(["forward", "inverse"] as const)("is east and north for shifts, %s", (shift) => {
    const { fit, axes } = fitted(shift);
    const [east, north, up] = axes;
    const sign = shift === "forward" ? 1 : -1;
    // Metres per radian: N cos φ and M at 46°, 400 m up.
    const [wide, high] = [6_389_218 * Math.cos((45.965 * Math.PI) / 180), 6_368_100];
    expect((sign * dot(vector(fit.centre, 0), east)) / wide).toBeCloseTo(1, 3);
    expect((sign * dot(vector(fit.centre, 1), north)) / high).toBeCloseTo(1, 3);
    for (const c of [0, 1]) {
      expect(Math.abs(dot(vector(fit.centre, c), up))).toBeLessThan(1);
      expect(fit.greatest[c] / [wide, high][c]).toBeCloseTo(1, 2);
      // Change with height: 400 m of 6,380 km, doubled; and nothing of first order in plan.
      expect(fit.error[c] / [wide, high][c]).toBeGreaterThan(0.9 * ((2 * 400) / 6.38e6));
      expect(fit.error[c] / [wide, high][c]).toBeLessThan(1.5 * ((2 * 400) / 6.38e6));
    }
    // Meridians come together to the north: metres per radian fall by sin φ of what one goes.
    const narrower =
      (sign * dot(vector(fit.byV, 0), east)) / (-(EDGE / 2) * Math.sin((45.965 * Math.PI) / 180));
    expect(narrower).toBeCloseTo(1, 1);
  });
});

import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance, random } from "../cartesian/points.fixture.js";
import { compileTransformation, type Domain, fitPlacement, place, placeIntegers } from "../index.js";
import { AREA, chanceSteps } from "./chance-grids.fixture.js";

const share = fc.noBias(fc.integer({ min: 0, max: 1e6 })).map((i) => i / 1e6);
const nodes = fc.record({
  at: fc.tuple(share, share),
  /** Decimal logarithm of the edge, 10 m to 3 km. */
  size: share.map((t) => 1 + 2.48 * t),
  height: share.map((t) => 3000 * t),
  /** Metres that neighbouring nodes of the grid differ by, from a tenth of a millimetre to a decimetre. */
  roughness: share.map((t) => 10 ** (-4 + 3 * t)),
  grids: fc.constantFrom("heights", "shifts", "both"),
  tolerance: fc.constantFrom(0.0005, 0.001, 0.01),
  seed: fc.integer({ min: 1, max: 1e6 }),
});

describe("placing over the cells of chance grids", () => {
  it("keeps its certificate in 400 nodes of every form, on lines, at corners, stored and not", () => {
    const forms = new Map<string, number>();
    let worst = 0;
    fc.assert(
      fc.property(nodes, ({ at, size, height, roughness, grids, tolerance, seed }) => {
        const edge = 10 ** size;
        const minX = AREA.minX + at[0] * (AREA.maxX - AREA.minX - edge);
        const minY = AREA.minY + at[1] * (AREA.maxY - AREA.minY - edge);
        const domain: Domain = { minX, minY, minZ: 0, maxX: minX + edge, maxY: minY + edge, maxZ: height };
        const steps = chanceSteps(roughness, seed, {
          shift: grids === "heights" ? undefined : "forward",
          heights: grids !== "shifts",
        });
        const compiled = compileTransformation({ steps });
        const placement = fitPlacement(compiled, domain, tolerance);
        const { scheme, creases, relief, remainders } = placement;
        const added = creases ? "creases" : relief ? "relief" : remainders.length > 0 ? "cells" : "alone";
        const form = scheme === "exact" ? scheme : added;
        forms.set(form, (forms.get(form) ?? 0) + 1);

        const next = random(seed);
        const count = 120;
        const scale = [edge / 2 ** 30, edge / 2 ** 30, height / 2 ** 30];
        const xyz = Int32Array.from({ length: 3 * count }, () => Math.floor(next() * 2 ** 30));
        const local = new Float32Array(3 * count);
        placeIntegers(placement, xyz, count, scale, [minX, minY, 0], local);
        const { origin, rotation: r } = placement.frame;
        const [want, got] = [new Float64Array(3), new Float64Array(3)];
        for (let i = 0; i < count; i++) {
          const [x, y, z] = [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + [minX, minY, 0][axis]);
          compiled.forward(x, y, z, want);
          const [e, n, u] = local.subarray(3 * i, 3 * i + 3);
          for (let axis = 0; axis < 3; axis++) {
            got[axis] = origin[axis] + r[axis] * e + r[axis + 3] * n + r[axis + 6] * u;
          }
          const stored = distance(got, want);
          expect(stored).toBeLessThanOrEqual(placement.bound);
          worst = Math.max(worst, stored / placement.bound);
          place(placement, x, y, z, got);
          expect(distance(got, want)).toBeLessThanOrEqual(
            placement.fitBound + (scheme === "exact" ? 1e-9 : 0),
          );
        }
      }),
      { numRuns: 400 },
    );
    const told = [...forms].map((pair) => pair.join(": ")).join(", ");
    console.log(
      `chance grids, 48,000 points (${told}), error up to ${(100 * worst).toFixed(0)} % of the bound`,
    );
    for (const form of ["creases", "relief", "cells", "alone"])
      expect(forms.get(form) ?? 0).toBeGreaterThan(0);
  });

  it("puts points outside of a node somewhere, never nowhere", () => {
    const steps = chanceSteps(0.2, 6, { heights: true });
    const domain = { minX: 497e3, minY: 5089e3, minZ: 0, maxX: 499e3, maxY: 5091e3, maxZ: 100 };
    const placement = fitPlacement(compileTransformation({ steps }), domain, 0.001);
    expect(placement.relief).toBeDefined();
    const far = Int32Array.of(-(2 ** 31), 0, 0, 2 ** 31 - 1, 2 ** 31 - 1, 0, 0, -(2 ** 31), 0);
    const out = new Float32Array(9).fill(Number.NaN);
    placeIntegers(placement, far, 3, [0.001, 0.001, 0.001], [498e3, 5090e3, 0], out);
    expect(out.every(Number.isFinite)).toBe(true);
  });
});

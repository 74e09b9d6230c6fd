import {
  type CompiledTransformation,
  compileTransformation,
  type Domain,
  fitPlacement,
  type Placement,
  place,
  placeIntegers,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { missingFor, type PipelineName, pipeline } from "./pipelines.js";
import { distance, random } from "./truth.js";

/** Where nodes are drawn from: source coordinates and heights. */
const AREAS: Readonly<Record<PipelineName, Domain>> = {
  "EPSG:7415": { minX: 60e3, minY: 370e3, minZ: -20, maxX: 240e3, maxY: 560e3, maxZ: 300 },
  "EPSG:2056+5728": { minX: 2520e3, minY: 1110e3, minZ: 200, maxX: 2780e3, maxY: 1260e3, maxZ: 4500 },
  "EPSG:21781+5728": { minX: 520e3, minY: 110e3, minZ: 200, maxX: 780e3, maxY: 260e3, maxZ: 4500 },
};

const want = new Float64Array(3);
const got = new Float64Array(3);

function nodeOf(area: Domain, edge: number, height: number, next: () => number): Domain {
  const minX = area.minX + next() * (area.maxX - area.minX - edge);
  const minY = area.minY + next() * (area.maxY - area.minY - edge);
  const minZ = area.minZ + next() * (area.maxZ - area.minZ - height);
  return { minX, minY, minZ, maxX: minX + edge, maxY: minY + edge, maxZ: minZ + height };
}

/** Greatest distance of placed points from {@link CompiledTransformation.forward}: as stored, and in float64. */
function measure(compiled: CompiledTransformation, placement: Placement, next: () => number, count: number) {
  const { minX, minY, minZ, maxX, maxY, maxZ } = placement.domain;
  const offset = [(minX + maxX) / 2, (minY + maxY) / 2, (minZ + maxZ) / 2];
  const scale = [(maxX - minX) * 2 ** -30, (maxY - minY) * 2 ** -30, (maxZ - minZ) * 2 ** -30];
  const xyz = new Int32Array(3 * count);
  for (let i = 0; i < 3 * count; i++) {
    const corner = (Math.floor(i / 3) >> (i % 3)) & 1 ? 1 : -1;
    xyz[i] = Math.trunc((i < 24 ? corner : 2 * next() - 1) * (2 ** 29 - 1));
  }
  const local = new Float32Array(3 * count).fill(Number.NaN);
  placeIntegers(placement, xyz, count, scale, offset, local);
  const { origin, rotation: r } = placement.frame;
  let stored = 0;
  let fitted = 0;
  for (let i = 0; i < count; i++) {
    const [x, y, z] = [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + offset[axis]);
    compiled.forward(x, y, z, want);
    const [e, n, u] = local.subarray(3 * i, 3 * i + 3);
    for (let axis = 0; axis < 3; axis++) {
      got[axis] = origin[axis] + r[axis] * e + r[axis + 3] * n + r[axis + 6] * u;
    }
    stored = Math.max(stored, distance(got, want));
    place(placement, x, y, z, got);
    fitted = Math.max(fitted, distance(got, want));
  }
  return { stored, fitted };
}

describe.each(Object.keys(AREAS) as PipelineName[])("nodes of %s", (name) => {
  it.skipIf(missingFor(name))("lie within their certified bound, whatever cells they cross", async () => {
    const area = AREAS[name];
    const compiled = compileTransformation(await pipeline(name, area), name);
    const next = random(7415);
    const crossing = new Map<number, number>();
    for (const edge of [0, 1, 100, 1000, 3000, 10e3, 20e3, 60e3]) {
      for (const tolerance of [3e-4, 1e-3, 1e-2]) {
        for (let i = 0; i < 15; i++) {
          const height = (area.maxZ - area.minZ) * next();
          const placement = fitPlacement(compiled, nodeOf(area, edge, height, next), tolerance, name);
          const { stored, fitted } = measure(compiled, placement, next, 150);
          expect(fitted).toBeLessThanOrEqual(placement.fitBound);
          expect(stored).toBeLessThanOrEqual(placement.bound);
          if (placement.storageBound < tolerance && placement.scheme !== "exact") {
            expect(placement.bound).toBeLessThanOrEqual(tolerance);
          }
          crossing.set(edge, (crossing.get(edge) ?? 0) + placement.remainders.length);
        }
      }
    }
    expect(crossing.get(1)).toBe(0);
    expect(crossing.get(10e3)).toBeGreaterThan(15);
  });

  it.skipIf(missingFor(name))("cost nothing more than without grids where one cell holds them", async () => {
    const area = AREAS[name];
    const compiled = compileTransformation(await pipeline(name, area), name);
    const next = random(1);
    for (let i = 0; i < 50; i++) {
      const placement = fitPlacement(compiled, nodeOf(area, 10, 100, next), 0.001, name);
      expect(["affine", "affineLinearNormal"]).toContain(placement.scheme);
      expect(placement.remainders).toHaveLength(0);
      expect(structuredClone(placement)).toEqual(placement);
    }
  });
});

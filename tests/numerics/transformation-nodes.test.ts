import {
  type CompiledTransformation,
  compileTransformation,
  type Domain,
  domainOf,
  ecefToGeodetic,
  fitPlacement,
  geodeticToEcef,
  type Placement,
  place,
  placeIntegers,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { missingFor, type PipelineName, pipeline } from "./pipelines.js";

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

/** The node moved so that a crossing of two lines of a grid, one in three times, or one line lies somewhere inside. */
function acrossLines(
  { transformation, inverse, forward }: CompiledTransformation,
  node: Domain,
  next: () => number,
): Domain {
  const grids = transformation.steps.flatMap((step) =>
    step.kind === "verticalShift" || step.kind === "horizontalShift" ? [step.window] : [],
  );
  const { west, south, stepLongitude, stepLatitude } = grids[Math.floor(next() * grids.length)];
  const [x, y] = [(node.minX + node.maxX) / 2, (node.minY + node.maxY) / 2];
  forward(x, y, node.minZ, want);
  const place = new Float64Array(3);
  ecefToGeodetic(want[0], want[1], want[2], place);
  const onLine = (value: number, start: number, step: number) =>
    start + step * Math.round((value - start) / step);
  const both = next() < 1 / 3;
  if (both || next() < 0.5) place[0] = onLine(place[0], west, stepLongitude);
  else place[1] = onLine(place[1], south, stepLatitude);
  if (both) place[1] = onLine(place[1], south, stepLatitude);
  geodeticToEcef(place[0], place[1], place[2], want);
  try {
    inverse(want[0], want[1], want[2], got);
  } catch {
    return node;
  }
  const [dx, dy] = [got[0] - x, got[1] - y].map((move, axis) => {
    const edge = axis === 0 ? node.maxX - node.minX : node.maxY - node.minY;
    return move + 0.8 * (next() - 0.5) * edge;
  });
  const moved = {
    ...node,
    minX: node.minX + dx,
    maxX: node.maxX + dx,
    minY: node.minY + dy,
    maxY: node.maxY + dy,
  };
  const { minX, minY, maxX, maxY } = domainOf(transformation);
  const inside = moved.minX >= minX && moved.maxX <= maxX && moved.minY >= minY && moved.maxY <= maxY;
  return inside ? moved : node;
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
          const { remainders, creases, relief } = placement;
          crossing.set(edge, (crossing.get(edge) ?? 0) + remainders.length + (creases || relief ? 1 : 0));
        }
      }
    }
    expect(crossing.get(1)).toBe(0);
    expect(crossing.get(10e3)).toBeGreaterThan(15);
  });

  it.skipIf(missingFor(name))(
    "hold their certificate where lines of a grid cross them, in each of the forms",
    async () => {
      const area = AREAS[name];
      const compiled = compileTransformation(await pipeline(name, area), name);
      const next = random(5728);
      const schemes = new Map<string, number>();
      let [points, worst] = [0, 0];
      for (const edge of [50, 200, 500, 1000, 1500, 2500]) {
        for (let i = 0; i < 150; i++) {
          const node = acrossLines(compiled, nodeOf(area, edge, 200 * next(), next), next);
          const placement = fitPlacement(compiled, node, [1e-3, 3e-4][i % 2], name);
          const { scheme, creases, relief } = placement;
          if (!creases && !relief) continue;
          const kind = `${scheme} ${relief ? "on relief" : "with creases"}`;
          schemes.set(kind, (schemes.get(kind) ?? 0) + 1);
          const { stored, fitted } = measure(compiled, placement, next, 400);
          points += 400;
          worst = Math.max(worst, stored / placement.bound);
          expect(fitted).toBeLessThanOrEqual(placement.fitBound);
          expect(stored).toBeLessThanOrEqual(placement.bound);
          expect(structuredClone(placement)).toEqual(placement);
        }
      }
      console.log(
        `${name}: ${points} points in nodes that lines cross (${[...schemes].map((pair) => pair.join(": ")).join(", ")}), error up to ${(100 * worst).toFixed(0)} % of the bound`,
      );
      expect(schemes.get("quadratic with creases") ?? 0).toBeGreaterThan(20);
      // Where two grids have their lines, heights are not all that is added.
      if (name !== "EPSG:7415") expect(schemes.get("quadratic on relief") ?? 0).toBeGreaterThan(20);
    },
  );

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

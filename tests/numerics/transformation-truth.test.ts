import { readFileSync } from "node:fs";
import {
  compileTransformation,
  decodeTransformation,
  encodeTransformation,
  fitPlacement,
  placeIntegers,
  type Rectangle,
} from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { data } from "../project.js";
import { missingFor, PIPELINES, type PipelineName, pipeline } from "./pipelines.js";

type Row = readonly [x: number, y: number, z: number, X: number, Y: number, Z: number];

const MILLIMETRE = 1e-3;

function rowsOf(name: PipelineName): readonly Row[] {
  return (JSON.parse(readFileSync(data(`truth/${PIPELINES[name].truth}`).path, "utf8")) as { rows: Row[] })
    .rows;
}

function around(rows: readonly Row[]): Rectangle {
  const [xs, ys] = [rows.map(([x]) => x), rows.map(([, y]) => y)];
  return { minX: Math.min(...xs), minY: Math.min(...ys), maxX: Math.max(...xs), maxY: Math.max(...ys) };
}

async function fromRecord(name: PipelineName, domain: Rectangle) {
  const bytes = encodeTransformation(await pipeline(name, domain));
  return compileTransformation(decodeTransformation(bytes, name), name);
}

describe.each(Object.keys(PIPELINES) as PipelineName[])("%s from its encoded record", (name) => {
  const missing = missingFor(name);

  it.skipIf(missing)("is where PROJ with grids puts it, and leads back", async () => {
    const rows = rowsOf(name);
    const compiled = await fromRecord(name, around(rows));
    const first = compiled.transformation.steps[0];
    const bound = first.kind === "projection" ? first.patchwork.bound : Number.NaN;
    const ecef = new Float64Array(3);
    const source = new Float64Array(3);
    let greatest = 0;
    for (const [x, y, z, ...expected] of rows) {
      compiled.forward(x, y, z, ecef);
      greatest = Math.max(greatest, distance(ecef, expected));
      // PROJ prints its truth to 0.1 µm at best.
      expect(distance(ecef, expected)).toBeLessThanOrEqual(bound + 1e-7);
      compiled.inverse(ecef[0], ecef[1], ecef[2], source);
      expect(distance(source, [x, y, z])).toBeLessThan(1e-6);
    }
    expect(rows).toHaveLength(1500);
    // The README says 0.007 mm.
    expect(greatest).toBeLessThan(0.0075e-3);
    expect(bound).toBeLessThan(MILLIMETRE);
  });

  it.skipIf(missing)("is there within 1 mm as float32 vertices of nodes of 30 m to 10 km", async () => {
    const rows = rowsOf(name);
    const domain = around(rows);
    const compiled = await fromRecord(name, domain);
    const next = random(1);
    const scale = [0.0001, 0.0001, 0.0001];
    const local = new Float32Array(3);
    const ecef = [0, 0, 0];
    for (const [x, y, z, ...expected] of rows) {
      const edge = 30 * 10 ** (2.5 * next());
      const [minX, minY] = [x - edge * next(), y - edge * next()];
      const node = {
        ...{ minX: Math.max(minX, domain.minX), minY: Math.max(minY, domain.minY), minZ: z - 100 * next() },
        ...{ maxX: Math.min(minX + edge, domain.maxX), maxY: Math.min(minY + edge, domain.maxY) },
        maxZ: z + 100 * next(),
      };
      const placement = fitPlacement(compiled, node, MILLIMETRE, name);
      placeIntegers(placement, Int32Array.of(7, -9, 11), 1, scale, [x - 7e-4, y + 9e-4, z - 11e-4], local);
      const { origin, rotation: r } = placement.frame;
      for (let axis = 0; axis < 3; axis++) {
        ecef[axis] = origin[axis] + r[axis] * local[0] + r[axis + 3] * local[1] + r[axis + 6] * local[2];
      }
      expect(placement.bound).toBeLessThanOrEqual(MILLIMETRE);
      expect(distance(ecef, expected)).toBeLessThanOrEqual(placement.bound + 1e-7);
    }
  });
});

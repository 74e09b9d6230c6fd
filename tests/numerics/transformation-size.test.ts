import { decodeTransformation, encodeTransformation } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { random } from "../../georef/src/cartesian/points.fixture.js";
import { missingFor, type PipelineName, pipeline } from "./pipelines.js";

describe("an encoded transformation", () => {
  const sizes: ReadonlyArray<[PipelineName, edge: number, bytes: number]> = [
    ["EPSG:7415", 10e3, 1.5e3],
    ["EPSG:7415", 50e3, 6.5e3],
    ["EPSG:2056+5728", 10e3, 8e3],
    ["EPSG:2056+5728", 50e3, 64e3],
  ];
  for (const [name, edge, most] of sizes) {
    const missing = missingFor(name);
    const skipped = missing ? ` (${missing})` : "";
    it.skipIf(missing)(`of ${name} over ${edge} m takes at most ${most} bytes${skipped}`, async () => {
      const next = random(edge);
      const [x, y] = name === "EPSG:7415" ? [110e3, 430e3] : [2560e3, 1150e3];
      for (let i = 0; i < 5; i++) {
        const [minX, minY] = [x + 50e3 * next(), y + 50e3 * next()];
        const given = await pipeline(name, { minX, minY, maxX: minX + edge, maxY: minY + edge });
        const bytes = encodeTransformation(given);
        expect(bytes.length).toBeLessThanOrEqual(most);
        expect(given).toMatchObject(decodeTransformation(bytes, name));
      }
    });
  }
});

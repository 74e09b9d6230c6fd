import { compileTransformation, type Domain, fitPlacement, PlacementError } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { missingFor, type PipelineName, pipeline } from "./pipelines.js";

function codeOf(run: () => unknown): string | undefined {
  try {
    run();
    return undefined;
  } catch (error) {
    return error instanceof PlacementError ? error.code : String(error);
  }
}

const areas: ReadonlyArray<[PipelineName, Domain]> = [
  ["EPSG:7415", { minX: 80e3, minY: 400e3, minZ: -10, maxX: 200e3, maxY: 500e3, maxZ: 300 }],
  ["EPSG:2056+5728", { minX: 2550e3, minY: 1120e3, minZ: 200, maxX: 2750e3, maxY: 1250e3, maxZ: 4500 }],
];

describe.each(areas)("%s", (name, area) => {
  it.skipIf(missingFor(name))("has a Jacobian and an inverse that agree with it", async () => {
    const compiled = compileTransformation(await pipeline(name, area), name);
    const next = random(3);
    const [plus, minus, ecef, source] = [0, 0, 0, 0].map(() => new Float64Array(3));
    const jacobian = new Float64Array(9);
    const step = 0.5;
    for (let i = 0; i < 500; i++) {
      const point = [
        area.minX + next() * (area.maxX - area.minX),
        area.minY + next() * (area.maxY - area.minY),
        area.minZ + next() * (area.maxZ - area.minZ),
      ] as const;
      compiled.forward(...point, ecef);
      compiled.inverse(ecef[0], ecef[1], ecef[2], source);
      expect(distance(source, point)).toBeLessThan(1e-6);

      compiled.jacobian(...point, jacobian);
      for (let column = 0; column < 3; column++) {
        const moved = (by: number) =>
          point.map((value, c) => value + (c === column ? by : 0)) as [number, number, number];
        compiled.forward(...moved(step), plus);
        compiled.forward(...moved(-step), minus);
        for (let row = 0; row < 3; row++) {
          // A point within half a metre of a grid line sees two cells in the difference: their slopes differ by 1e-5.
          expect(Math.abs((plus[row] - minus[row]) / (2 * step) - jacobian[3 * row + column])).toBeLessThan(
            1e-4,
          );
        }
      }
    }
  });

  it.skipIf(missingFor(name))("refuses points outside by name", async () => {
    const compiled = compileTransformation(await pipeline(name, area), "scan.copc.laz");
    const out = new Float64Array(3);
    const outside = [area.minX - 1000, area.minY, 0] as const;
    expect(codeOf(() => compiled.forward(...outside, out))).toBe("PLACE_DOMAIN");
    expect(codeOf(() => compiled.jacobian(...outside, new Float64Array(9)))).toBe("PLACE_DOMAIN");
    compiled.evaluate(...outside, out, 0);
    expect(out.every(Number.isNaN)).toBe(true);
    expect(codeOf(() => compiled.inverse(0, 0, 0, out))).toBe("PLACE_DOMAIN");
    expect(codeOf(() => compiled.inverse(-4e6, -4e5, 5e6, out))).toBe("PLACE_DOMAIN");
    const node = { ...area, maxX: area.maxX + 1000 };
    expect(codeOf(() => fitPlacement(compiled, node, 0.001))).toBe("PLACE_DOMAIN");
  });
});

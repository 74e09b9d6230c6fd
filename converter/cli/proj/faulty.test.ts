import { describe, expect, it } from "vitest";
import { findProj } from "./program/find.js";
import { projTransformation } from "./transformation.js";

const proj = await findProj();
const METRE = { name: "metre", kind: "linear", size: 1, declared: true } as const;

describe.skipIf(!proj)(`MGI 1901${proj ? "" : " (skipped: PROJ is not installed)"}`, () => {
  it.each([
    ["north", 7_500_000, 4_720_000],
    ["south", 7_470_000, 4_650_000],
  ])(
    "goes by its neighbours in the %s of Kosovo, whose operation is wrong as it is registered",
    async (_, minX, minY) => {
      const code = "EPSG:3909";
      const crs = { name: code, code, proj4: "", horizontalUnit: METRE, verticalUnit: METRE } as const;
      const domain = { minX, minY, minZ: 0, maxX: minX + 1000, maxY: minY + 1000, maxZ: 100 };
      const { report } = await projTransformation(proj!, { ...crs, height: { kind: "unknown" } }, domain);
      expect(report.operation).toMatch(/MGI 1901 to WGS 84 \((10|11|15|1)\)/);
      expect(report.accuracy).toBeLessThan(20);
      const [over] = report.passedOver;
      if (over) expect(over).toMatchObject({ operation: expect.stringContaining("(14)"), why: /1,600 m/ });
    },
  );
});

import { describe, expect, it } from "vitest";
import { findProj } from "./program/find.js";
import { rectanglesOf } from "./source-areas.js";
import { splitPipeline } from "./step-text.js";

const proj = await findProj();

describe.skipIf(!proj)(
  `areas in source coordinates${proj ? "" : " (skipped: PROJ is not installed)"}`,
  () => {
    const of = (text: string, ...areas: (readonly [number, number, number, number])[]) =>
      rectanglesOf(proj!, splitPipeline(`+proj=pipeline ${text}`), areas);
    const UTM = "+step +inv +proj=utm +zone=31 +ellps=intl";

    it("are rectangles around the projected edges", async () => {
      const [[area]] = (await of(UTM, [0, 42, 6, 44])) as [
        [{ minX: number; minY: number; maxX: number; maxY: number }],
      ];
      // The meridian in the middle has the least northing of the southern edge, its corners the greatest of the northern one.
      expect(area.minY).toBeCloseTo(4_649_858.604, 3);
      expect(area.maxY).toBeGreaterThan(4_872_000);
      expect(area.minX + area.maxX).toBeCloseTo(1e6, 3);
    });

    it("are two across the antimeridian, and without end for the earth", async () => {
      const degrees = "+step +proj=unitconvert +xy_in=deg +xy_out=rad";
      const [fiji, earth] = await of(degrees, [176, -21, -178, -12], [-180, -90, 180, 90]);
      expect(fiji).toEqual([
        expect.objectContaining({ minX: expect.closeTo(176, 9), maxX: expect.closeTo(180, 9) }),
        expect.objectContaining({ minX: expect.closeTo(-180, 9), maxX: expect.closeTo(-178, 9) }),
      ]);
      expect(earth![0]!.maxX).toBeGreaterThan(1e9);
    });

    it("are refused where the projection has no way back", async () => {
      await expect(of("+step +proj=airy", [0, 42, 6, 44])).rejects.toMatchObject({ code: "PROJ_FAILED" });
    });
  },
);

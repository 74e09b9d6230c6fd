import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Domain } from "@groma/georef";
import { afterAll, describe, expect, it } from "vitest";
import { assemble } from "./assemble.js";
import { prepared, tryOperation } from "./candidate.js";
import { checkTransformation } from "./check.js";
import { geoTiff } from "./grids/geotiff.fixture.js";
import { findProj } from "./program/find.js";

const folder = mkdtempSync(join(tmpdir(), "groma-sampled-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
writeFileSync(join(folder, "translations.tif"), geoTiff("geocentric", [2, 49]));
writeFileSync(join(folder, "shifts.tif"), geoTiff("eastward", [2, 49]));
/** Two triangles that move the middle of Paris by metres, in degrees. */
const triangles = {
  ...{
    file_type: "triangulation_file",
    format_version: "1.0",
    transformed_components: ["horizontal", "vertical"],
  },
  vertices_columns: ["source_x", "source_y", "target_x", "target_y", "offset_z"],
  triangles_columns: ["idx_vertex1", "idx_vertex2", "idx_vertex3"],
  vertices: [
    [2, 48, 2.00001, 48.00002, 0.5],
    [3, 48, 3.00002, 48.00001, 0.7],
    [3, 49, 3.00001, 49.00001, 0.4],
    [2, 49, 2.002, 49, 0.6],
  ],
  triangles: [
    [0, 1, 2],
    [0, 2, 3],
  ],
};
writeFileSync(join(folder, "triangles.json"), JSON.stringify(triangles));

// Not that of the land survey: about what it does, under its name.
const [west, south] = [3_300_000, 6_600_000];
const corner = (x: number, y: number, off: number) => {
  return [x, y, 500_000 + (x - 3_500_000) * 0.9996 + off, y * 0.9996 - off];
};
const ykj = {
  ...{ file_type: "triangulation_file", format_version: "1.0", transformed_components: ["horizontal"] },
  vertices_columns: ["source_x", "source_y", "target_x", "target_y"],
  triangles_columns: ["idx_vertex1", "idx_vertex2", "idx_vertex3"],
  vertices: [
    corner(west, south, 1),
    corner(west + 200_000, south, 2),
    corner(west + 200_000, south + 200_000, 4),
    corner(west, south + 200_000, 3),
  ],
  triangles: triangles.triangles,
};
writeFileSync(join(folder, "fi_nls_ykj_etrs35fin.json"), JSON.stringify(ykj));

const plain = await findProj();
const proj = plain && (await findProj({ grids: folder }));
const box = (minX: number, minY: number, size: number): Domain => {
  return { minX, minY, minZ: 0, maxX: minX + size, maxY: minY + size, maxZ: 800 };
};

describe.skipIf(!proj)(
  `steps without a form of their own${proj ? "" : " (skipped: PROJ is not installed)"}`,
  () => {
    const UTM = "+step +inv +proj=utm +zone=31 +ellps=GRS80";
    const CART = "+step +proj=cart +ellps=WGS84";
    const degrees = (step: string) =>
      `+step +proj=unitconvert +xy_in=rad +xy_out=deg ${step} +step +proj=unitconvert +xy_in=deg +xy_out=rad`;

    it.each([
      ["gridshift, in one cell", "+step +proj=gridshift +grids=shifts.tif", 1500],
      ["tinshift, in one triangle", degrees("+step +proj=tinshift +file=triangles.json"), 3000],
      [
        "vertoffset",
        "+step +proj=vertoffset +lat_0=48 +lon_0=2 +dh=-0.245 +slope_lat=-0.21 +slope_lon=-0.032 +ellps=GRS80",
        20_000,
      ],
      [
        "xyzgridshift",
        "+step +proj=push +v_3 +step +proj=cart +ellps=clrk80ign +step +proj=xyzgridshift +grids=translations.tif +grid_ref=output_crs +ellps=GRS80 +step +inv +proj=cart +ellps=GRS80 +step +proj=pop +v_3",
        2000,
      ],
    ])("are taken as PROJ gives them: %s", async (_, steps, size) => {
      const domain = box(448_000, 5_411_000, size);
      const { sampled, worstDifference, patchwork } = await followed(
        `+proj=pipeline ${UTM} ${steps} ${CART}`,
        domain,
      );
      expect(sampled).toBe(1);
      expect(worstDifference).toBeLessThan(4e-5);
      expect(worstDifference).toBeLessThanOrEqual(patchwork.bound + 1e-6);
    });

    it("give way where no raster is fine enough", async () => {
      // Across the edge of two triangles of which one is turned by a thousandth.
      const steps = degrees("+step +proj=tinshift +file=triangles.json");
      const domain = box(432_000, 5_350_000, 50_000);
      const pipeline = `+proj=pipeline ${UTM} ${steps} ${CART}`;
      const operation = { name: "test", accuracy: 1, area: "", ballpark: false, missingGrids: [], pipeline };
      const candidate = await tryOperation(proj!, operation, domain, 1);
      await expect(prepared(proj!, candidate, domain)).rejects.toMatchObject({
        code: "CRS_OPERATION_UNSUPPORTED",
        cause: expect.stringMatching(/"tinshift".* m off/),
      });
    });

    it("are a part of the projection where they stand before it: the triangles of Finland's old plane", async () => {
      const pipeline = `+proj=pipeline +step +proj=axisswap +order=2,1 +step +proj=tinshift +file=fi_nls_ykj_etrs35fin.json +step +inv +proj=utm +zone=35 +ellps=GRS80 ${CART}`;
      const domain = box(3_385_000, 6_675_000, 3000);
      const { worstDifference, patchwork } = await followed(pipeline, domain);
      expect(worstDifference).toBeLessThanOrEqual(patchwork.bound + 1e-6);
    });
  },
);

/** A pipeline as a transformation, and how far that is from it. */
async function followed(pipeline: string, domain: Domain) {
  const operation = { name: "test", accuracy: 1, area: "", ballpark: false, missingGrids: [], pipeline };
  const choice = await prepared(proj!, await tryOperation(proj!, operation, domain, 1), domain);
  const { transformation, patchwork } = await assemble(proj!, [{ ...choice, areas: [] }], {
    ...{ domain, tolerance: 2e-5, file: "test" },
  });
  const ways = [{ pipeline: choice.candidate.plan.pipeline, areas: [] }];
  const check = await checkTransformation(proj!, ways, transformation, domain, 1, "test");
  return { ...check, patchwork, sampled: choice.sampled.length };
}

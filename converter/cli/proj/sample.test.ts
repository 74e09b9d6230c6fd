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
writeFileSync(
  join(folder, "south-east.json"),
  JSON.stringify({ ...triangles, triangles: triangles.triangles.slice(0, 1) }),
);

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

/** Velocities on nodes every tenth of a degree from 2° E, 48° N, millimetres a year: the formats that `deformation` reads. */
const NODES = 11;
const velocity = (row: number, column: number, part: number) =>
  20 * Math.sin(0.3 * row + 0.2 * column + 2 * part);
/** CTABLE V2: east and north. */
function ctable2(): Buffer {
  const bytes = Buffer.alloc(160 + 8 * NODES * NODES);
  bytes.write("CTABLE V2.0     made for a test");
  const radians = Math.PI / 180;
  for (const [i, value] of [2, 48, 0.1, 0.1].entries()) bytes.writeDoubleLE(value * radians, 96 + 8 * i);
  for (const at of [128, 132]) bytes.writeInt32LE(NODES, at);
  for (let i = 0; i < NODES * NODES; i++) {
    for (const part of [0, 1])
      bytes.writeFloatLE(velocity(Math.floor(i / NODES), i % NODES, part), 160 + 8 * i + 4 * part);
  }
  return bytes;
}
/** GTX: up. */
function gtx(): Buffer {
  const bytes = Buffer.alloc(40 + 4 * NODES * NODES);
  for (const [i, value] of [48, 2, 0.1, 0.1].entries()) bytes.writeDoubleBE(value, 8 * i);
  for (const at of [32, 36]) bytes.writeInt32BE(NODES, at);
  for (let i = 0; i < NODES * NODES; i++)
    bytes.writeFloatBE(velocity(Math.floor(i / NODES), i % NODES, 2), 40 + 4 * i);
  return bytes;
}
writeFileSync(join(folder, "velocities.ct2"), ctable2());
writeFileSync(join(folder, "uplift.gtx"), gtx());
const deformation = (time: string) =>
  `+step +proj=cart +ellps=WGS84 +step +proj=deformation +xy_grids=velocities.ct2 +z_grids=uplift.gtx +ellps=WGS84 ${time} +step +inv +proj=cart +ellps=WGS84`;

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
      ["deformation, over twenty years, in one cell", deformation("+dt=20"), 2000, 450_500],
      [
        "deformation, at an epoch",
        `+step +proj=set +v_4=2020.5 ${deformation("+t_epoch=2000")}`,
        2000,
        450_500,
      ],
      [
        "xyzgridshift",
        "+step +proj=push +v_3 +step +proj=cart +ellps=clrk80ign +step +proj=xyzgridshift +grids=translations.tif +grid_ref=output_crs +ellps=GRS80 +step +inv +proj=cart +ellps=GRS80 +step +proj=pop +v_3",
        2000,
      ],
    ])("are taken as PROJ gives them: %s", async (_, steps, size, east = 448_000) => {
      const domain = box(east, 5_411_000, size);
      const { sampled, worstDifference, patchwork } = await followed(
        `+proj=pipeline ${UTM} ${steps} ${CART}`,
        domain,
      );
      expect(sampled).toBe(1);
      expect(worstDifference).toBeLessThan(4e-5);
      expect(worstDifference).toBeLessThanOrEqual(patchwork.bound + 1e-6);
    });

    it("move with the velocities of a grid for the time since their epoch", async () => {
      const place = async (steps: string) => {
        const operation = { name: "test", accuracy: 1, area: "", ballpark: false, missingGrids: [] };
        const pipeline = `+proj=pipeline ${UTM} ${steps} ${CART}`;
        const { places } = await tryOperation(
          proj!,
          { ...operation, pipeline },
          box(448_000, 5_411_000, 2000),
          1,
        );
        return places.slice(0, 3);
      };
      const [still, moved, dated] = [
        await place(""),
        await place(deformation("+dt=20.5")),
        await place(`+step +proj=set +v_4=2020.5 ${deformation("+t_epoch=2000")}`),
      ];
      expect(moved).toEqual(dated);
      const far = Math.hypot(...still.map((value, axis) => value - moved[axis]));
      expect(far).toBeGreaterThan(0.2);
      expect(far).toBeLessThan(0.8);
      // PROJ itself needs a time for it.
      await expect(place(deformation("+t_epoch=2000"))).rejects.toMatchObject({
        code: "CRS_OPERATION_UNSUPPORTED",
        cause: expect.stringContaining("deformation"),
      });
    });

    it.each([
      // Of the two triangles one is turned by a thousandth.
      ["no raster is fine enough", "triangles.json", box(432_000, 5_350_000, 50_000), /"tinshift".* m off/],
      [
        "they reach a part of the data",
        "south-east.json",
        box(463_000, 5_372_100, 3000),
        /"tinshift".* is not known in all/,
      ],
    ])("give way where %s", async (_, file, domain, cause) => {
      const steps = degrees(`+step +proj=tinshift +file=${file}`);
      const pipeline = `+proj=pipeline ${UTM} ${steps} ${CART}`;
      const operation = { name: "test", accuracy: 1, area: "", ballpark: false, missingGrids: [], pipeline };
      const candidate = await tryOperation(proj!, operation, domain, 1);
      await expect(prepared(proj!, candidate, domain)).rejects.toMatchObject({
        code: "CRS_OPERATION_UNSUPPORTED",
        cause: expect.stringMatching(cause),
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

import { mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { type Bounds, compileTransformation, type Grid, type Step } from "@groma/georef";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { runToRadians } from "../cct.js";
import { findProj, type Proj } from "../program/find.js";
import { splitPipeline } from "../step-text.js";
import { composite } from "./composite.js";
import { cutFrom } from "./cut.js";
import { geoTiff } from "./geotiff.fixture.js";
import { locateGrid } from "./locate.js";
import { openGrid } from "./open.js";

const DEGREE = Math.PI / 180;
const folder = mkdtempSync(join(tmpdir(), "groma-grids-"));
afterAll(() => rmSync(folder, { recursive: true, force: true }));
const here = (await findProj()) !== undefined;
const absent = here ? "" : " (skipped: PROJ is not installed)";

/** NTv2 sub-grids of arc-seconds, from the south-east, west positive. */
function ntv2(
  grids: { name: string; parent: string; box: number[]; step: number }[],
  little: boolean,
): Buffer {
  const records: Buffer[] = [];
  const put = (key: string, write: (buffer: Buffer) => void) => {
    const record = Buffer.alloc(16);
    record.write(key.padEnd(8), 0, "latin1");
    write(record);
    records.push(record);
  };
  const int = (value: number) => (b: Buffer) =>
    little ? b.writeInt32LE(value, 8) : b.writeInt32BE(value, 8);
  const real = (value: number) => (b: Buffer) =>
    little ? b.writeDoubleLE(value, 8) : b.writeDoubleBE(value, 8);
  const text = (value: string) => (b: Buffer) => void b.write(value.padEnd(8), 8, "latin1");
  put("NUM_OREC", int(11));
  put("NUM_SREC", int(11));
  put("NUM_FILE", int(grids.length));
  put("GS_TYPE", text("SECONDS"));
  put("VERSION", text("TEST"));
  put("SYSTEM_F", text("A"));
  put("SYSTEM_T", text("B"));
  for (const key of ["MAJOR_F", "MINOR_F", "MAJOR_T", "MINOR_T"]) put(key, real(6378137));
  for (const { name, parent, box, step } of grids) {
    const [west, south, east, north] = box.map((degrees) => degrees * 3600);
    const [columns, rows] = [(east - west) / step + 1, (north - south) / step + 1].map(Math.round);
    put("SUB_NAME", text(name));
    put("PARENT", text(parent));
    put("CREATED", text(""));
    put("UPDATED", text(""));
    put("S_LAT", real(south));
    put("N_LAT", real(north));
    put("E_LONG", real(-east));
    put("W_LONG", real(-west));
    put("LAT_INC", real(step));
    put("LONG_INC", real(step));
    put("GS_COUNT", int(columns * rows));
    for (let row = 0; row < rows; row++) {
      for (let column = columns - 1; column >= 0; column--) {
        const [x, y] = [west + column * step, south + row * step];
        const node = Buffer.alloc(16);
        const shifts = [1 + Math.sin(x / 2000) + y / 1e5, -4 + Math.cos(y / 1500) - x / 1e5];
        for (const [i, shift] of shifts.entries()) {
          if (little) node.writeFloatLE(shift, 4 * i);
          else node.writeFloatBE(shift, 4 * i);
        }
        records.push(node);
      }
    }
  }
  return Buffer.concat(records);
}

function gtx(west: number, south: number, step: number, columns: number, rows: number, hole: number): Buffer {
  const bytes = Buffer.alloc(40 + 4 * columns * rows);
  for (const [i, value] of [south, west, step, step].entries()) bytes.writeDoubleBE(value, 8 * i);
  bytes.writeInt32BE(rows, 32);
  bytes.writeInt32BE(columns, 36);
  for (let i = 0; i < columns * rows; i++)
    bytes.writeFloatBE(i === hole ? -88.8888 : 40 + Math.sin(i), 40 + 4 * i);
  return bytes;
}

const BOX: Bounds = { west: 5.2 * DEGREE, south: 52.1 * DEGREE, east: 5.6 * DEGREE, north: 52.3 * DEGREE };
const PARENT = { name: "PARENT", parent: "NONE", box: [5, 52, 6, 52.5], step: 360 };
const CHILD = { name: "CHILD", parent: "PARENT", box: [5.2, 52.1, 5.5, 52.3], step: 120 };

/** Greatest distance (metres) between a window and PROJ at places across the box, and how many have a place. */
async function compare(proj: Proj, name: string, kind: "vertical" | "horizontal", box = BOX) {
  const operation =
    kind === "vertical" ? `+proj=vgridshift +multiplier=1 +grids=${name}` : `+proj=hgridshift +grids=${name}`;
  const window = await cutFrom(await openGrid(join(folder, name), name, kind), box);
  if (!window) throw new Error("no window");
  const shift: Step =
    kind === "vertical"
      ? { kind: "verticalShift", multiplier: 1, window }
      : { kind: "horizontalShift", direction: "forward", window };
  // u and v run over the patch, whose linear coefficients make radians of degrees.
  const [x0, x1, y0, y1] = [box.west, box.east, box.south, box.north].map((radians) => radians / DEGREE);
  const half = [(x1 - x0) / 2, (y1 - y0) / 2].map((value) => value * DEGREE);
  const middle = [(x0 + x1) / 2, (y0 + y1) / 2].map((value) => value * DEGREE);
  const coefficients = Float64Array.of(middle[0], 0, half[0], 0, middle[1], half[1], 0, 0);
  const patch = { minX: x0, minY: y0, maxX: x1, maxY: y1, degree: 1, coefficients };
  const { evaluate } = compileTransformation({
    steps: [{ kind: "projection", patchwork: { patches: [patch], bound: 0 } }, shift],
  });
  const points: number[] = [];
  for (let i = 0; i < 400; i++) {
    points.push(x0 + (x1 - x0) * ((i * 0.7548776662) % 1), y0 + (y1 - y0) * ((i * 0.569840291) % 1), 10);
  }
  const truth = await runToRadians(
    proj,
    splitPipeline(`+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step ${operation}`),
    Float64Array.from(points),
  );
  let worst = 0;
  let count = 0;
  const own = new Float64Array(3);
  for (let i = 0; i < points.length; i += 3) {
    evaluate(points[i], points[i + 1], points[i + 2], own, 0);
    expect(Number.isFinite(own[0] + own[2])).toBe(Number.isFinite(truth[i]));
    if (!Number.isFinite(truth[i])) continue;
    count++;
    const plane = Math.hypot((own[0] - truth[i]) * Math.cos(own[1]), own[1] - truth[i + 1]) * 6378137;
    worst = Math.max(worst, Math.hypot(plane, own[2] - truth[i + 2]));
  }
  return { worst, count };
}

describe.skipIf(!here)(`windows of grids against PROJ${absent}`, () => {
  let proj: Proj;
  beforeAll(async () => {
    writeFileSync(join(folder, "one.gsb"), ntv2([PARENT], true));
    writeFileSync(join(folder, "big.gsb"), ntv2([PARENT], false));
    writeFileSync(join(folder, "nested.gsb"), ntv2([PARENT, CHILD], true));
    writeFileSync(join(folder, "hole.gtx"), gtx(5, 52, 0.1, 11, 6, 24));
    writeFileSync(join(folder, "east.gtx"), gtx(185, 52, 0.1, 11, 6, -1));
    writeFileSync(join(folder, "area.tif"), geoTiff("vertical"));
    writeFileSync(join(folder, "shift.tif"), geoTiff("horizontal"));
    proj = (await findProj({ grids: folder }))!;
  });

  it.each(["one.gsb", "big.gsb"])("NTv2 in both byte orders: %s", async (name) => {
    const { worst, count } = await compare(proj, name, "horizontal");
    expect(count).toBe(400);
    expect(worst).toBeLessThan(2e-5);
  });

  it("the finer of nested grids where it lies", async () => {
    const inside = {
      ...BOX,
      east: 5.45 * DEGREE,
      west: 5.25 * DEGREE,
      south: 52.12 * DEGREE,
      north: 52.28 * DEGREE,
    };
    const { worst } = await compare(proj, "nested.gsb", "horizontal", inside);
    expect(worst).toBeLessThan(2e-5);
    const window = await cutFrom(
      await openGrid(join(folder, "nested.gsb"), "nested.gsb", "horizontal"),
      inside,
    );
    expect(window!.stepLongitude).toBeCloseTo((120 / 3600) * DEGREE, 12);
  });

  it("GTX with a hole", async () => {
    const { worst, count } = await compare(proj, "hole.gtx", "vertical");
    expect(count).toBeGreaterThan(300);
    expect(worst).toBeLessThan(1e-6);
  });

  it("GTX counted from 0° to 360°", async () => {
    const box = { west: -174.9 * DEGREE, east: -174.2 * DEGREE, south: 52.1 * DEGREE, north: 52.3 * DEGREE };
    const { worst, count } = await compare(proj, "east.gtx", "vertical", box);
    expect(count).toBe(400);
    expect(worst).toBeLessThan(1e-6);
  });

  it("GeoTIFF with scale, offset, pixels as areas and longitude to the west", async () => {
    const heights = await compare(proj, "area.tif", "vertical");
    expect(heights.count).toBe(400);
    expect(heights.worst).toBeLessThan(1e-6);
    const shifts = await compare(proj, "shift.tif", "horizontal");
    expect(shifts.count).toBe(400);
    expect(shifts.worst).toBeLessThan(2e-5);
  });

  it("stay in PROJ's folders", async () => {
    symlinkSync(join(folder, "one.gsb"), join(folder, "link.gsb"));
    expect(await locateGrid(proj, "link.gsb")).toBe(join(folder, "link.gsb"));
    expect(await locateGrid(proj, "not-there.tif")).toBeUndefined();
    for (const name of [
      "../x.gsb",
      "/etc/passwd",
      "a/../../b.tif",
      "~/x.tif",
      ".hidden",
      "https://x/y.tif",
      "",
    ]) {
      await expect(locateGrid(proj, name), name).rejects.toMatchObject({ code: "PROJ_GRID" });
    }
  });
});

describe("a grid file", () => {
  const open = (name: string, bytes: Buffer, kind: "vertical" | "horizontal") => {
    writeFileSync(join(folder, name), bytes);
    return openGrid(join(folder, name), name, kind);
  };
  const whole = ntv2([PARENT], true);
  const heights = gtx(5, 52, 0.1, 11, 6, -1);
  const changed = (bytes: Buffer, change: (copy: Buffer) => void) => {
    const copy = Buffer.from(bytes);
    change(copy);
    return copy;
  };

  it.each([
    ["empty", "a.gtx", Buffer.alloc(0), "vertical"],
    ["a head alone", "b.gtx", heights.subarray(0, 40), "vertical"],
    ["of a billion nodes", "c.gtx", changed(heights, (b) => b.writeInt32BE(1e9, 32)), "vertical"],
    ["of negative steps", "d.gtx", changed(heights, (b) => b.writeDoubleBE(-1, 16)), "vertical"],
    ["cut off", "e.gsb", whole.subarray(0, whole.length - 1), "horizontal"],
    ["of other units", "f.gsb", changed(whole, (b) => void b.write("DEGREES ", 56)), "horizontal"],
    ["of a thousand parts", "g.gsb", changed(whole, (b) => b.writeInt32LE(1000, 40)), "horizontal"],
    [
      "of steps of nothing",
      "h.gsb",
      changed(whole, (b) => b.writeDoubleLE(0, 11 * 16 + 8 * 16 + 8)),
      "horizontal",
    ],
    ["of shifts for heights", "i.gsb", whole, "vertical"],
    ["a broken TIFF", "j.tif", Buffer.from("II*\0\xff\xff\xff\xff", "latin1"), "vertical"],
    ["text", "k.tif", Buffer.from("<html>not found</html>"), "horizontal"],
  ] as const)("that is %s is refused by name", async (_, name, bytes, kind) => {
    await expect(open(name, bytes, kind)).rejects.toMatchObject({ code: "PROJ_GRID", file: name });
  });

  it("of heights in shifts' place is refused", async () => {
    await expect(open("l.tif", geoTiff("vertical"), "horizontal")).rejects.toMatchObject({
      code: "PROJ_GRID",
    });
    await expect(open("m.tif", geoTiff("horizontal"), "vertical")).rejects.toMatchObject({
      code: "PROJ_GRID",
    });
  });
});

describe("a grid made of finer and coarser ones", () => {
  const grid = (west: number, step: number, count: number, value: Grid["value"]): Grid => ({
    ...{ grid: "g", west, south: 0, stepLongitude: step, stepLatitude: step, columns: count, rows: count },
    ...{ channels: 1, unit: 1, value },
  });
  const coarse = grid(0, 4, 5, (_, row, column) => row * 100 + column);

  it("is the coarse surface outside and the fine nodes inside", () => {
    const fine = grid(4, 1, 5, (_, row, column) => -(row * 100 + column));
    const one = composite(coarse, [{ area: { west: 4, south: 0, east: 8, north: 4 }, grid: fine }]);
    expect([one.columns, one.rows, one.stepLongitude]).toEqual([17, 17, 1]);
    expect(one.value(0, 2, 5)).toBe(-201);
    expect(one.value(0, 6, 2)).toBe(150.5);
    expect(one.value(0, 8, 16)).toBe(204);
  });

  it("is refused when they do not fit", () => {
    const area = { west: 4, south: 0, east: 8, north: 4 };
    const skewed = grid(4.3, 1, 5, () => 0);
    expect(() => composite(coarse, [{ area, grid: skewed }])).toThrow(/do not fit/);
  });
});

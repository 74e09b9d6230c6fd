import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { exactTransform, placePoint, resolveCrs } from "@groma/georef";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { ORIGIN, SIZE } from "./area.js";
import { generateSample } from "./generate.js";
import { LV95_LN02_WKT } from "./wkt.js";

const POINTS = 60_000;

/** The fields of a record that the tests look at. */
interface Record {
  x: number;
  y: number;
  z: number;
  returnNumber: number;
  returns: number;
  classification: number;
  source: number;
  gpsTime: number;
  colour: readonly [number, number, number];
}

/** Reads the file by the offsets of LAS 1.4 R15, tables 3 and 16, independently of the writer. */
function read(bytes: Uint8Array): Record[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const [first, size, count] = [
    view.getUint32(96, true),
    view.getUint16(105, true),
    Number(view.getBigUint64(247, true)),
  ];
  expect(bytes.length).toBe(first + size * count);
  return Array.from({ length: count }, (_, i) => {
    const at = first + i * size;
    const coordinate = (axis: number) =>
      view.getInt32(at + 4 * axis, true) * view.getFloat64(131 + 8 * axis, true) +
      view.getFloat64(155 + 8 * axis, true);
    const channel = (index: number) => view.getUint16(at + 30 + 2 * index, true);
    return {
      ...{ x: coordinate(0), y: coordinate(1), z: coordinate(2) },
      returnNumber: view.getUint8(at + 14) & 15,
      returns: view.getUint8(at + 14) >> 4,
      classification: view.getUint8(at + 16),
      source: view.getUint16(at + 20, true),
      gpsTime: view.getFloat64(at + 22, true),
      colour: [channel(0), channel(1), channel(2)],
    };
  });
}

const generator = fileURLToPath(new URL("dist/generate.js", import.meta.url));
const hash = (bytes: Uint8Array) => createHash("sha256").update(bytes).digest("hex");

describe("sample scan", () => {
  let bytes: Uint8Array;
  let records: Record[];
  beforeAll(() => {
    bytes = generateSample({ points: POINTS });
    records = read(bytes);
  });

  it("is the same for the same options and another for another seed", () => {
    expect(hash(generateSample({ points: POINTS }))).toBe(hash(bytes));
    expect(hash(generateSample({ points: POINTS, seed: 2 }))).not.toBe(hash(bytes));
  });

  it("has about as many points as asked for, all within the square", () => {
    expect(Math.abs(records.length / POINTS - 1)).toBeLessThan(0.1);
    for (const { x, y } of records) {
      if (x < ORIGIN.east || y < ORIGIN.north || x > ORIGIN.east + SIZE || y > ORIGIN.north + SIZE) {
        expect.fail(`a point lies at ${x}, ${y}`);
      }
    }
  });

  it("numbers the echoes of each pulse from one to their count, in falling height", () => {
    for (let i = 0; i < records.length; ) {
      const pulse = records.slice(i, i + records[i].returns);
      const numbers = pulse.map(({ returnNumber }) => returnNumber);
      expect(numbers).toEqual(pulse.map((_, echo) => echo + 1));
      expect(new Set(pulse.map(({ gpsTime, returns }) => `${gpsTime} ${returns}`)).size).toBe(1);
      for (let echo = 1; echo < pulse.length; echo++) expect(pulse[echo].z).toBeLessThan(pulse[echo - 1].z);
      i += pulse.length;
    }
  });

  it("flies its lines one after the other", () => {
    const lines = records.map(({ source }) => source);
    expect([...new Set(lines)]).toEqual([101, 102, 103, 104, 105]);
    for (let i = 1; i < records.length; i++) {
      if (records[i].gpsTime < records[i - 1].gpsTime || lines[i] < lines[i - 1])
        expect.fail(`at point ${i}`);
    }
  });

  it("holds every class of the valley, colours of sixteen bits, pulses with several echoes", () => {
    const classes = new Set(records.map(({ classification }) => classification));
    for (const code of [2, 3, 4, 5, 6, 9, 11, 14, 15]) expect(classes).toContain(code);
    expect(records.some(({ colour }) => colour.some((channel) => channel % 257 !== 0 && channel > 255))).toBe(
      true,
    );
    expect(records.some(({ returns }) => returns >= 4)).toBe(true);
  });

  it("keeps the counts and bounds of its header", () => {
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    const firsts = records.filter(({ returnNumber }) => returnNumber === 1).length;
    expect(Number(view.getBigUint64(255, true))).toBe(firsts);
    const heights = records.map(({ z }) => z);
    expect(view.getFloat64(211, true)).toBeCloseTo(
      heights.reduce((a, b) => Math.max(a, b)),
      9,
    );
    expect(view.getFloat64(219, true)).toBeCloseTo(
      heights.reduce((a, b) => Math.min(a, b)),
      9,
    );
  });
});

describe("WKT of the sample", () => {
  it("is read as LV95 and LN02, in the Lauterbrunnen valley", () => {
    const crs = resolveCrs({ file: "sample.las", wkt: LV95_LN02_WKT });
    expect(crs).toMatchObject({ code: "EPSG:2056+5728", height: { kind: "geoid", epsg: 5728 } });
    const ecef = new Float64Array(3);
    placePoint(exactTransform(crs), ORIGIN.east, ORIGIN.north, 0, ecef);
    // PROJ 9.5.1: inverse somerc, then the three parameters between push and pop of v_3, then cart on WGS 84.
    const truth = [4349312.341707739, 603841.4891293793, 4610448.230783753];
    expect(Math.hypot(...truth.map((value, axis) => value - ecef[axis]))).toBeLessThan(1e-3);
  });
});

describe("generate.js", () => {
  const folder = mkdtempSync(join(tmpdir(), "groma-sample-"));
  afterAll(() => rmSync(folder, { recursive: true }));
  const generate = (...args: string[]) =>
    spawnSync(process.execPath, [generator, ...args], { encoding: "utf8" });

  it("writes the file of generateSample and nothing else", () => {
    const out = join(folder, "sample.las");
    expect(generate(out, "2000")).toMatchObject({ status: 0, stderr: "" });
    expect(hash(readFileSync(out))).toBe(hash(generateSample({ points: 2000 })));
    expect(readdirSync(folder)).toEqual(["sample.las"]);
  });

  it.each([
    { args: [], message: /^OPTION_INVALID: generate: no output file is named\. / },
    {
      args: ["out.las", "many"],
      message: /^OPTION_INVALID: generate: many is not 1000 to 50000000 points\. /,
    },
    {
      args: [join(folder, "no-such", "out.las"), "2000"],
      message: /^OUTPUT_WRITE: .*no-such.*ENOENT.*\. Name a file/,
    },
  ])("refuses $args", ({ args, message }) => {
    const { status, stderr } = generate(...args);
    expect(stderr).toMatch(message);
    expect(status).toBe(1);
  });
});

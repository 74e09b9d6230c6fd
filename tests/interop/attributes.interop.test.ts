import { openAsBlob, rmSync } from "node:fs";
import { join } from "node:path";
import { type AttributeInfo, type NodeVertices, PointCloud } from "@groma/layer";
import { afterAll, describe, expect, it } from "vitest";
import { convert, converted } from "../converted.js";
import { localExecutor } from "../faults/local-executor.js";
import { data } from "../project.js";
import { runPython } from "../python.js";
import { refereesMissing, titled } from "./comparison.js";
import { makeFolder } from "./core.js";

/** One record by laspy: numbers as text, null where there is no value. */
type Row = Readonly<Record<string, string | null>>;

/** laspy's names of what has another one here; flags are bits of one byte. */
const NAMES: Readonly<Record<string, string>> = {
  returnNumber: "return_number",
  numberOfReturns: "number_of_returns",
  userData: "user_data",
  pointSourceId: "point_source_id",
  gpsTime: "gps_time",
};
const FLAGS = ["synthetic", "key_point", "withheld", "overlap"] as const;

const expected = (row: Row, name: string): number => {
  const bit = (flag: string, shift: number) => Number(row[flag]) << shift;
  if (name === "flags") {
    const classification = FLAGS.reduce((sum, flag, shift) => sum | bit(flag, shift), 0);
    const scanner = bit("scanner_channel", 4) | bit("scan_direction_flag", 6) | bit("edge_of_flight_line", 7);
    return classification | scanner;
  }
  if (name === "scanAngle") return Number(row.scan_angle) * 0.006;
  const text = row[NAMES[name] ?? name];
  if (text === undefined) throw new Error(`laspy knows no ${name}`);
  return text === null ? Number.NaN : Number(text);
};

/** Any system serves here: places are not what is compared. */
const LV95 =
  "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel +towgs84=674.374,15.056,405.346,0,0,0,0 +units=m";

/** Opens a file as a page does, but decodes on this thread. */
async function open(path: string, crs?: string): Promise<PointCloud> {
  return PointCloud.fromUrl(await openAsBlob(path), { crs, executor: localExecutor() });
}

interface Asked {
  readonly key: string;
  readonly index: number;
}

/** Records of the first nodes, spread over each. */
async function ask(cloud: PointCloud, keys: readonly string[], each: number): Promise<Asked[]> {
  const asked: Asked[] = [];
  for (const key of keys) {
    const { count } = await cloud.loadNode(key);
    for (let turn = 0; turn < each; turn++) asked.push({ key, index: Math.floor((turn * count) / each) });
  }
  return asked;
}

/** Compares single points and columns with what laspy reads; returns how many values were compared. */
async function compare(path: string, cloud: PointCloud, asked: readonly Asked[]): Promise<number> {
  const rows = runPython<Row[]>("interop/attributes.py", ["read", path], JSON.stringify(asked));
  const nodes = new Map<string, NodeVertices>();
  for (const key of new Set(asked.map((one) => one.key))) nodes.set(key, await cloud.loadNode(key));
  let compared = 0;
  for (const [turn, { key, index }] of asked.entries()) {
    const row = rows[turn]!;
    const { integers, attributes, node } = await cloud.readPoint(key, { record: index });
    const { columns, order } = nodes.get(key)!;
    const drawn = order.indexOf(index);
    expect([node, ...integers]).toEqual([key, ...["X", "Y", "Z"].map((axis) => Number(row[axis]))]);
    expect((await cloud.readPoint(key, drawn)).index).toBe(index);
    for (const [name, value] of Object.entries(attributes)) {
      if (typeof value === "bigint") expect(String(value), name).toBe(row[name]);
      else expect(value, name).toBe(expected(row, name));
      compared++;
      const column = columns.get(name);
      if (!column) continue;
      const { data: stored, scale, offset, constant, noData, bound } = column;
      const shown =
        constant?.[0] ?? (stored[drawn] === noData ? Number.NaN : stored[drawn]! * scale + offset);
      if (Number.isNaN(expected(row, name))) expect(shown, name).toBeNaN();
      else expect(Math.abs(shown - expected(row, name)), name).toBeLessThanOrEqual(bound);
    }
  }
  return compared;
}

const named = (attributes: readonly AttributeInfo[], name: string) =>
  attributes.find((attribute) => attribute.name === name);

describe.skipIf(refereesMissing)(
  "attributes of points are those that laspy reads",
  { timeout: 180_000 },
  () => {
    const folder = makeFolder();
    afterAll(() => rmSync(folder, { recursive: true, force: true }));

    it.each([6, 7, 8])("in format %i with extra bytes of seven types", async (format) => {
      const scan = join(folder, `every-${format}.las`);
      const copc = join(folder, `every-${format}.copc.laz`);
      runPython("interop/attributes.py", ["make", scan, String(format), "20000"]);
      convert(scan, copc, ["--crs", "EPSG:2056"]);
      const cloud = await open(copc, LV95);
      const compared = await compare(copc, cloud, await ask(cloud, ["0-0-0-0"], 100));
      expect(compared).toBe(100 * (9 + [0, 3, 4][format - 6]! + 7));
      expect(named(cloud.attributes, "height above ground")).toMatchObject({
        ...{ kind: "scalar", label: "metres above ground", components: 1 },
        range: [expect.any(Number), expect.any(Number)],
      });
      const [least, greatest] = named(cloud.attributes, "reflectance")?.range ?? [];
      expect([least, greatest].every((value) => Math.abs(value! + 20) <= 327.68)).toBe(true);
      const { columns } = await cloud.loadNode("0-0-0-0");
      expect(columns.get("quality")?.constant).toEqual([7]);
      expect(columns.has("nir")).toBe(format === 8);
      cloud.destroy();
    });

    const autzen = data("autzen.laz");
    it.skipIf(autzen.missing)(titled("in a real scan", autzen.missing), async () => {
      const copc = converted(autzen.path);
      const cloud = await open(copc);
      const asked = await ask(cloud, ["0-0-0-0", "1-0-0-0", "2-1-1-0"], 50);
      expect(await compare(copc, cloud, asked)).toBe(150 * 12);
      cloud.destroy();
    });
  },
);

import { mkdtempSync, openAsBlob, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { PointCloud } from "@groma/layer";
import {
  cutFacts,
  type ExportedPoints,
  exportPicture,
  exportPoints,
  MemorySink,
  type PointExportOptions,
} from "@groma/layer/export";
import { Clip, ClipSet, Corridor, Profile } from "@groma/layer/tools";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { completeStyle, defaultStyle, OFFSET } from "../../layer/src/effects/index.js";
import { converted } from "../converted.js";
import { localExecutor } from "../faults/local-executor.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";
import { groma } from "./groma.js";

interface Judged {
  readonly count: number;
  readonly of: number;
  readonly written: number;
  readonly doubtful: number;
  readonly complete: boolean;
  readonly nothingElse: boolean;
}

let folder = "";
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), "groma-export-"));
});
afterAll(() => rmSync(folder, { recursive: true }));

/** Exports as a page does, and has the referee judge it. @returns the bytes of the file */
async function judged(
  scan: string,
  from: ExportedPoints,
  options: PointExportOptions,
  wanted: object,
): Promise<{ bytes: Uint8Array; found: Judged }> {
  const sink = new MemorySink();
  const written = await exportPoints(from, sink, options);
  const bytes = new Uint8Array(await sink.blob("application/vnd.las").arrayBuffer());
  const file = join(folder, "points.las");
  writeFileSync(file, bytes);
  const found = runPython<Judged>("interop/exported.py", [scan, file, JSON.stringify(wanted)]);
  expect(found).toMatchObject({ written, complete: true, nothingElse: true });
  // Neither nothing nor everything, or the referee would have little to say.
  expect(found.count).toBeGreaterThan(100);
  return { bytes, found };
}

/** The bytes that the command line writes of the same. */
function commanded(args: readonly string[]): Buffer {
  const out = join(folder, "command.las");
  const run = groma([...args, "--out", out, "--overwrite"]);
  expect(run.stderr).not.toMatch(/^[A-Z]+_[A-Z]+:/m);
  return readFileSync(out);
}

const road = data("vol_total.laz");

/** EPSG:1766, by which the scan is placed: geocentric translation of LV03. Its heights are taken over as ellipsoidal. */
const PIPELINE = [
  "+proj=pipeline",
  "+step +inv +proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +x_0=600000 +y_0=200000 +ellps=bessel",
  "+step +proj=push +v_3 +step +proj=cart +ellps=bessel",
  "+step +proj=helmert +x=674.374 +y=15.056 +z=405.346",
  "+step +inv +proj=cart +ellps=WGS84 +step +proj=pop +v_3 +step +proj=cart +ellps=WGS84",
].join(" ");

describe.skipIf(road.missing ?? coreMissing ?? pythonMissing)("exports of a real scan", () => {
  let cloud: PointCloud;
  let scan = "";
  beforeAll(async () => {
    scan = converted(road.path);
    cloud = await PointCloud.fromUrl(await openAsBlob(scan), { executor: localExecutor() });
  });
  afterAll(() => cloud?.destroy());

  it("are all of its records", async () => {
    const { found } = await judged(scan, cloud, {}, {});
    expect(found.written).toBe(found.of);
  });

  it("are what a turned box and a plane leave, on the globe, by page and command line alike", async () => {
    const source = [589_800, 231_430, 750] as const;
    const place = [...cloud.place(...source)];
    const turns = { heading: 0.6, pitch: 0.1, roll: -0.05 };
    const box = Clip.box({ center: { source }, size: [180, 90, 26], ...turns });
    const plane = Clip.plane({ through: { source }, heading: 2.1, pitch: -0.3 });
    const parts = {
      box: { center: place, size: box.size, ...turns },
      plane: { through: place, heading: 2.1, pitch: -0.3 },
    };
    for (const [name, clip] of [
      ["box", box],
      ["plane", plane],
    ] as const) {
      const wanted = { [name]: parts[name], pipeline: PIPELINE };
      const { bytes, found } = await judged(scan, cloud, { clips: new ClipSet([clip]) }, wanted);
      expect(found.count).toBeLessThan(found.of);
      const file = join(folder, "clips.json");
      writeFileSync(file, JSON.stringify([clip]));
      expect(Buffer.compare(commanded(["clip", scan, "--clips", file]), Buffer.from(bytes))).toBe(0);
    }
  });

  it("are what a polygon, a plane and a filter leave together", async () => {
    const ring = [
      [589_650, 231_350],
      [589_990, 231_340],
      [589_900, 231_520],
      [589_780, 231_420],
    ] as [number, number][];
    const source = [589_850, 231_400, 745] as const;
    const plane = Clip.plane({ through: { source }, heading: 1, pitch: 0.2, mode: "outside" });
    const inward = { through: [...cloud.place(...source)], heading: 1 + Math.PI, pitch: -0.2 };
    const clips = new ClipSet([Clip.polygon(ring, { coordinates: "source" }), plane]);
    const ranges = { elevation: [735, 762.25], userData: [0, 3] } as const;
    const wanted = {
      polygon: [ring],
      plane: inward,
      pipeline: PIPELINE,
      ranges: { elevation: ranges.elevation },
    };
    const { bytes } = await judged(scan, cloud, { clips, filter: { ranges } }, wanted);
    const file = join(folder, "clips.json");
    writeFileSync(file, JSON.stringify([...clips]));
    const options = ["--clips", file, "--range", "elevation=735,762.25", "--range", "userData=0,3"];
    expect(Buffer.compare(commanded(["clip", scan, ...options]), Buffer.from(bytes))).toBe(0);
  });

  it.each(["intensity", "classification", "elevation", "side"])(
    "are pictures by %s, the same from the command line",
    async (by) => {
      const line = [
        [589_650, 231_380],
        [589_800, 231_430],
      ] as const;
      const strip = new Corridor(line, 8);
      const range = by === "intensity" ? ([10, 2000] as const) : undefined;
      const sides = { name: OFFSET, kind: "scalar", range: [-4, 4] } as const;
      const attributes = [sides, ...cloud.attributes];
      const base = defaultStyle({ attributes });
      const color = by === "side" ? OFFSET : by;
      const style = completeStyle({ color, range }, base, { name: cloud.name, attributes });
      const paint = { style, attributes, rgbBits: cloud.statistics?.rgbBits ?? undefined };
      const sink = new MemorySink();
      const facts = cutFacts("line", cloud.crs);
      await exportPicture([{ origin: cloud, volume: strip, along: strip }], sink, {
        facts,
        format: "svg",
        paint,
      });
      const file = join(folder, "line.geojson");
      writeFileSync(file, JSON.stringify({ type: "LineString", coordinates: line }));
      const options = ["--line", file, "--line-crs", "source", "--width", "8", "--color-by", by];
      const out = join(folder, "picture.svg");
      const run = groma([
        "profile",
        scan,
        ...options,
        ...(range ? ["--color-range", range.join()] : []),
        "--out",
        out,
        "--overwrite",
      ]);
      expect(run).toMatchObject({ code: 0 });
      expect(readFileSync(out, "utf8")).toBe(
        new TextDecoder().decode(sink.bytes()).replace(">file<", ">vol_total.copc.laz<"),
      );
    },
  );

  it("are what a filter leaves of a profile, whose last piece is short", async () => {
    const angles = [
      [589_650, 231_380],
      [589_880, 231_450],
      [589_883, 231_449],
    ].map(([x, y]) => {
      const located = JSON.parse(groma(["locate", scan, "--points", "-", "--json"], `${x} ${y} 750`).stdout);
      return located.points[0].geodetic.slice(0, 2) as [number, number];
    });
    const line = angles.map(
      ([longitude, latitude]) => [longitude * (Math.PI / 180), latitude * (Math.PI / 180)] as const,
    );
    const profile = new Profile(cloud, { line, width: 12 });
    const ranges = { elevation: [725, 755.5] } as const;
    const strip = { line: profile.strip.vertices, width: 12 };
    const { bytes } = await judged(scan, profile, { filter: { ranges } }, { strip, ranges });
    const file = join(folder, "line.geojson");
    writeFileSync(file, JSON.stringify({ type: "LineString", coordinates: angles }));
    const command = ["profile", scan, "--line", file, "--width", "12", "--range", "elevation=725,755.5"];
    expect(Buffer.compare(commanded(command), Buffer.from(bytes))).toBe(0);
  });
});

const autzen = data("autzen.laz");
const left = process.env.GROMA_EXPORT === "1" ? autzen.missing : "GROMA_EXPORT=1 asks for ten million points";

describe.skipIf(left ?? coreMissing ?? pythonMissing)(
  `exports of ten million points${left ? ` (skipped: ${left})` : ""}`,
  () => {
    it("are what polygon, classes, returns and intensities leave", { timeout: 600_000 }, async () => {
      const scan = converted(autzen.path);
      const cloud = await PointCloud.fromUrl(await openAsBlob(scan), { executor: localExecutor() });
      try {
        const { min, max } = cloud.boundingBox;
        const at = (u: number, v: number) =>
          [min[0] + u * (max[0] - min[0]), min[1] + v * (max[1] - min[1])] as [number, number];
        const ring = [at(0.2, 0.1), at(0.9, 0.3), at(0.6, 0.95), at(0.5, 0.4)];
        const clips = new ClipSet([Clip.polygon(ring, { coordinates: "source" })]);
        const filter = {
          ...{ classes: [0], returns: ["last"] as const },
          ranges: { intensity: [20, 120] as const, elevation: [410, 480] as const },
        };
        const wanted = { polygon: [ring], ...filter };
        const { found } = await judged(scan, cloud, { clips, filter }, wanted);
        console.info(JSON.stringify(found));
        expect(found.of).toBe(10_653_336);
      } finally {
        cloud.destroy();
      }
    });
  },
);

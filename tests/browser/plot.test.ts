import { readFileSync } from "node:fs";
import { basename, dirname } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pointPaint } from "../../layer/src/effects/index.js";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing } from "../python.js";
import { colourDifference, screenshot } from "./harness.js";
import { openStage, type StagePage } from "./stage.js";
import { longestTask } from "./trace.js";

const UTM = { "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs" };
/** 20 × 20 m at 20 pixels per metre, in the plane of the scan. */
const ABOVE = { projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 0.05 };
/** Strips of the scan `terraces`, 4 m each, the next one 1.2 m above the one before. */
const STRIPS = [0, 1, 2, 3, 4];

/** Styles in which the strips differ, and filters that leave some of them. */
const LOOKS: readonly (readonly [name: string, style: object, filter?: object])[] = [
  ["the scan's colours", { color: "rgb" }],
  ["tone", { color: "rgb", gamma: 1.8, brightness: 0.1, contrast: -0.3 }],
  ["intensity", { color: "intensity", gamma: 1, brightness: 0, contrast: 0 }],
  ["elevation in a gradient", { color: "elevation", gradient: "turbo" }],
  ["height above the ellipsoid", { color: "ellipsoidalHeight", gradient: "viridis" }],
  ["64-bit times", { color: "gpsTime", gradient: "spectral" }],
  ["extra bytes within a range", { color: "amplitude", range: [-1, 3], gradient: "cividis" }],
  [
    "a gradient of stops",
    {
      ...{ color: "scanAngle", range: undefined },
      gradient: [
        { at: 0, color: [1, 0, 0] },
        { at: 0.4, color: [1, 1, 0] },
        { at: 1, color: [0, 0, 1] },
      ],
    },
  ],
  ["classes", { color: "classification", classes: { 6: { color: [0.2, 0.9, 0.4] } } }],
  ["two in one", { color: "rgb", blend: { color: "classification", share: 0.4 } }],
  ["translucency", { color: "rgb", blend: undefined, opacity: 0.5 }],
  ["discs", { opacity: 1, shape: "disc", pointSize: 5 }],
  ["hidden classes", { shape: "square", pointSize: 3, classes: { 3: { show: false } } }],
  ["a filter by returns", { classes: { 3: { show: true } } }, { returns: ["first", "last"] }],
  ["a filter by ranges", {}, { ranges: { pointSourceId: [101, 103] } }],
  ["a filter by heights", {}, { ranges: { elevation: [500.5, 503] } }],
];

describe.skipIf(pythonMissing)(
  `the plot of a profile${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;

    beforeAll(async () => {
      stage = await openStage("map-stage");
      const source = { url: "/clouds/terraces.copc.laz" };
      const options = { view: ABOVE, layer: { style: { pointSize: 3 } }, source, projections: UTM };
      await stage.page.evaluate(async (text) => {
        const { MapStage, PlotStage, ol } = window.map;
        window.map.stage = new MapStage(JSON.parse(text)) as typeof window.map.stage;
        await window.map.stage.complete();
        const toAngles = ol.proj4("EPSG:32632", "EPSG:4326");
        const line = [-10, 10].map((east) =>
          toAngles.forward([500_000 + east, 5_200_000]).map((degrees) => (degrees * Math.PI) / 180),
        ) as [number, number][];
        const cloud = window.map.stage.source.cloud!;
        window.map.plot = new PlotStage(window.map.stage, cloud, { line, width: 4 }, [0, 20, 499.5, 505.5]);
        await window.map.plot.read();
      }, JSON.stringify(options));
    }, 240_000);

    afterAll(() => stage?.close());

    /** Colours of the strips by the code that colours pictures on paper. */
    const painting = async (strips: readonly number[]) => {
      const { records, style, attributes, rgbBits } = await stage.page.evaluate(async (wanted) => {
        const { plot, stage } = window.map;
        const cloud = stage.source.cloud!;
        const records = await Promise.all(
          wanted.map(async (strip) => {
            for (const { batch, chainage } of plot.parts) {
              const at = chainage.findIndex((along) => Math.abs(along - 2 - 4 * strip) < 0.06);
              if (at < 0) continue;
              const record = await cloud.readPoint(batch.key, { record: batch.inside[at]! });
              const geodetic = stage.heightOf(cloud, record.source);
              return { ...record.attributes, elevation: record.source[2], ellipsoidalHeight: geodetic };
            }
            throw new Error("no point there");
          }),
        );
        const rgbBits = cloud.statistics?.rgbBits ?? 8;
        return { records, style: stage.layer.style!, attributes: cloud.attributes, rgbBits };
      }, strips);
      const values = records as Record<string, number>[];
      const paint = pointPaint(
        { style, attributes },
        { numbersOf: (name) => ({ value: (record) => values[record]![name] ?? Number.NaN }), rgbBits },
      );
      return values.map((_, record) => {
        const out = new Uint8ClampedArray(3);
        paint(record, out);
        return [...out];
      });
    };

    it("looks as the layer does, in every style and with every filter", { timeout: 240_000 }, async () => {
      for (const [name, style, filter] of LOOKS) {
        const [plot, map] = await stage.page.evaluate(
          async ([style, filter, strips]) => {
            const { plot, stage } = window.map;
            await plot.restyle(style, filter);
            const { data, width } = stage.pixels();
            const above = strips.map((strip) => {
              const at = 4 * (200 * width + 300 + 20 * (4 * strip - 8));
              return [...data.subarray(at, at + 4)];
            });
            const aside = strips.map((strip) =>
              plot.colourAt(...plot.view.pixelOf(2 + 4 * strip, 500 + 1.2 * strip)),
            );
            return [aside, above] as const;
          },
          [style, filter, STRIPS] as const,
        );
        const painted = await painting(STRIPS);
        for (const strip of STRIPS) {
          if (plot[strip]![3] !== 255) continue;
          expect(
            colourDifference(painted[strip]!, plot[strip]!.slice(0, 3)),
            `${name} on paper, strip ${strip}`,
          ).toBeLessThan(2);
        }
        if (name === "the scan's colours") await screenshot(stage.page, "plot-terraces");
        for (const strip of STRIPS) {
          const told = `${name}, strip ${strip}: ${plot[strip]} in the plot, ${map[strip]} on the map`;
          expect(plot[strip]![3], told).toBe(map[strip]![3]);
          if (map[strip]![3]! > 0) expect(colourDifference(plot[strip]!, map[strip]!), told).toBeLessThan(2);
        }
        // A test of nothing but grey, or of nothing at all, would hold nothing.
        expect(new Set(plot.map(String)).size, name).toBeGreaterThan(1);
      }
    });

    it("draws each point once while nodes come, and sends nothing to the GPU to pan and zoom", {
      timeout: 120_000,
    }, async () => {
      const { points, nodes, read, moved, steps, grown, anew, hovered } = await stage.page.evaluate(
        async () => {
          const { plot: before, stage, PlotStage } = window.map;
          await before.restyle({ color: "rgb", classes: { 3: { show: true } } }, undefined);
          const again = new PlotStage(stage, stage.source.cloud!, before.options, [0, 20, 499.5, 505.5]);
          await again.read(7);
          const read = again.asked();
          const grown = again.picture();
          const steps = 20;
          for (let step = 0; step < steps; step++) {
            again.view.panBy(5, -3);
            again.view.zoomAt(300, 150, 1.05);
            await again.settle();
          }
          const moved = again.asked();
          again.view.fit({ from: 0, to: 20, low: 499.5, high: 505.5 });
          await again.settle();
          again.asked();
          await again.settle();
          const result = {
            ...{ points: again.series.points, nodes: again.parts.length, steps, read, moved, grown },
            ...{ anew: again.picture(), hovered: again.asked() },
          };
          again.destroy();
          return result;
        },
      );
      expect(nodes).toBe(7);
      expect(points).toBeGreaterThan(7000);
      expect(read.pointsDrawn).toBe(points);
      expect(read.columns).toBe(2 * nodes);
      expect(moved).toEqual({ columns: 0, pointsDrawn: steps * points, textureBytes: expect.any(Number) });
      // What is sent is where each node lies: a row of texels.
      expect(moved.textureBytes / steps).toBeLessThanOrEqual(4096 * Math.ceil(nodes / 16));
      expect(anew).toBe(grown);
      expect(hovered.pointsDrawn).toBe(0);
    });

    it("points at what is seen alone, by exact values", { timeout: 120_000 }, async () => {
      const seen = await stage.page.evaluate(async () => {
        const { plot } = window.map;
        const strips = async (style: object, filter: object | undefined) => {
          await plot.restyle(style, filter);
          const found = new Set<number>();
          for (const part of plot.parts) {
            for (let index = 0; index < part.chainage.length; index++) {
              if (plot.series.shows(part, index)) found.add(Math.floor(part.chainage[index]! / 4));
            }
          }
          return [...found].sort();
        };
        return [
          await strips({ classes: { 3: { show: false } } }, undefined),
          await strips({ classes: { 3: { show: true } } }, { ranges: { elevation: [500.5, 503] } }),
          await strips({}, { ranges: { ellipsoidalHeight: [502, 600] } }),
          await strips({}, { returns: ["last"] }),
        ];
      });
      expect(seen).toEqual([[0, 2, 3, 4], [1, 2], [2, 3, 4], [expect.any(Number)]]);
    });
  },
);

const autzen = data("autzen.laz");
const asked = process.env.GROMA_PLOT === "1";
const left = asked ? autzen.missing : "GROMA_PLOT=1 asks for a million points, some minutes";

describe.skipIf(left)(`the plot of a million points${left ? ` (skipped: ${left})` : ""}`, () => {
  it("has a picture 300 ms after its first node, and never holds the thread", {
    timeout: 600_000,
  }, async () => {
    const file = converted(autzen.path);
    const stage = await openStage("map-stage", { "/scans/": dirname(file) });
    const { page } = stage;
    const browser = page.context().browser()!;
    try {
      const source = { url: "/clouds/terraces.copc.laz" };
      const options = JSON.stringify({ view: ABOVE, source, projections: UTM });
      await page.evaluate(
        async ([text, name]) => {
          const { layer, MapStage, PlotStage, lineThrough } = window.map;
          window.map.stage = new MapStage(JSON.parse(text!)) as typeof window.map.stage;
          await window.map.stage.complete();
          const cloud = await layer.PointCloud.fromUrl(`/scans/${name}`);
          const { min, max } = cloud.boundingBox;
          // A sixth of the cloud, feet.
          const width = ((max[1] - min[1]) / 6) * 0.3048;
          const plotted = { line: lineThrough(cloud), width };
          window.map.plot = new PlotStage(window.map.stage, cloud, plotted, [0, 1200, 100, 200]);
        },
        [options, basename(file)],
      );
      await browser.startTracing(page, { categories: ["toplevel", "devtools.timeline"] });
      const read = await page.evaluate(() => window.map.plot.readInFrames());
      const reading = longestTask(await browser.stopTracing());
      await browser.startTracing(page, { categories: ["toplevel", "devtools.timeline"] });
      const frames = await page.evaluate(async () => {
        const { plot } = window.map;
        plot.asked();
        for (let step = 0; step < 10; step++) {
          plot.view.panBy(5, -3);
          await new Promise(requestAnimationFrame);
          await plot.settle();
        }
        return plot.asked();
      });
      const panning = longestTask(await browser.stopTracing());
      console.info(JSON.stringify({ ...read, reading, panning, frames }));
      expect(read.points).toBeGreaterThan(1_000_000);
      expect(read.first).toBeLessThan(300);
      expect(frames.columns).toBe(0);
      expect(reading.threadMs).toBeLessThan(8);
      expect(panning.threadMs).toBeLessThan(8);
    } finally {
      await stage.close();
    }
  });
});

describe.skipIf(left)(`exports of a page${left ? ` (skipped: ${left})` : ""}`, () => {
  it("take a third more than decoding, and half a gigabyte for ten million points", {
    timeout: 900_000,
  }, async () => {
    const file = converted(autzen.path);
    const stage = await openStage("map-stage", { "/scans/": dirname(file) });
    const { page } = stage;
    try {
      const session = await page.context().browser()!.newBrowserCDPSession();
      const renderers = async () => {
        const { processInfo } = await session.send("SystemInfo.getProcessInfo");
        return processInfo.filter(({ type }) => type === "renderer");
      };
      const seconds = async () => (await renderers()).reduce((sum, { cpuTime }) => sum + cpuTime, 0);
      await page.evaluate(async (name) => {
        const { layer, tools, lineThrough } = window.map;
        const cloud = await layer.PointCloud.fromUrl(`/scans/${name}`);
        const { min, max } = cloud.boundingBox;
        const width = ((max[1] - min[1]) / 6) * 0.3048;
        Object.assign(window, {
          cloud,
          profile: new tools.Profile(cloud, { line: lineThrough(cloud), width }),
        });
      }, basename(file));
      const timed = async (task: "decode" | "profile" | "all") => {
        const before = await seconds();
        const points = await page.evaluate(async (what) => {
          const { exporting } = window.map;
          const { cloud, profile } = window as unknown as {
            cloud: import("@groma/layer/openlayers").PointCloud;
            profile: import("@groma/layer/tools").Profile;
          };
          const nowhere = { write: async () => {}, overwrite: async () => {} };
          if (what !== "decode") return exporting.exportPoints(what === "all" ? cloud : profile, nowhere);
          const { volume } = profile;
          const touched = { toBox: (box: Float64Array) => volume.toBox(box), contains: () => false };
          let read = 0;
          for await (const { records } of cloud.query({ volume: touched }).batches()) read += records.count;
          return read;
        }, task);
        return { points, seconds: (await seconds()) - before };
      };
      await timed("decode");
      const least = { decode: Number.POSITIVE_INFINITY, profile: Number.POSITIVE_INFINITY };
      for (let round = 0; round < 2; round++) {
        for (const task of ["decode", "profile"] as const)
          least[task] = Math.min(least[task], (await timed(task)).seconds);
      }
      const all = await timed("all");
      const peaks = (await renderers()).map(({ id }) =>
        Number(/VmHWM:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8"))![1]),
      );
      const megabytes = Math.max(...peaks) / 1024;
      console.info(JSON.stringify({ ...least, ratio: least.profile / least.decode, all, megabytes }));
      expect(all.points).toBe(10_653_336);
      expect(least.profile / least.decode).toBeLessThan(1.3);
      expect(megabytes).toBeLessThan(500);
    } finally {
      await stage.close();
    }
  });
});

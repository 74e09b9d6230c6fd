import { dirname } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { screenshot } from "./harness.js";
import type { MapStage } from "./map-stage/map-stage.js";
import { openStage, type StagePage } from "./stage.js";

/** NAD83(HARN) / Oregon GIC Lambert in international feet, EPSG:2994, and its shift to WGS 84 by EPSG:1901. */
const OREGON =
  "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +y_0=0 +ellps=GRS80 +units=ft +no_defs";
const SHIFTED = `${OREGON} +towgs84=-0.991,1.9072,0.5129,0.0257899075194932,0.0096500989602704,0.0116599432323421,0`;

/** Projections by code, as an application registers them. */
const PROJECTIONS = {
  "EPSG:2994": `${OREGON} +towgs84=0,0,0,0,0,0,0`,
  "EPSG:32610": "+proj=utm +zone=10 +datum=WGS84 +units=m +no_defs",
  "EPSG:3413":
    "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs",
};

/** Units of each map per metre of its pixels. */
const MAPS = { "EPSG:3857": 1, "EPSG:32610": 1, "EPSG:2994": 0.3048, "EPSG:3413": 1, "EPSG:4326": 111319.49 };
type Code = keyof typeof MAPS;
const CODES = Object.keys(MAPS) as Code[];
const ROTATIONS = [0, 0.7, -2.2];

/** Metres of a pixel. */
const RESOLUTION = 0.05;
/** Pixels of the canvas for each of the map: a point covers as many squared, so that its middle is known to half of one. */
const RATIO = 2;

type Referee = { points: ({ source: number[] } & Record<Code, [number, number]>)[]; all: number };

const scan = data("autzen.laz");
const missing = scan.missing ?? pythonMissing;

describe.skipIf(missing)(`Autzen on maps of OpenLayers${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let stage: StagePage;
  let referee: Referee;
  beforeAll(async () => {
    const path = converted(scan.path);
    stage = await openStage("map-stage", { "/scans/": dirname(path) });
    // A square of 26 ft on the pitch of the stadium, where points lie on the grass one by one.
    const targets = CODES.map((code) => `${code}=${code === "EPSG:2994" ? SHIFTED : code}`);
    const where = ["637135", "850900", "20", "1.2", "100"];
    referee = runPython<Referee>("browser/map.py", [path, SHIFTED, ...where, ...targets]);
    await stage.page.evaluate(
      ([projections, ratio]) => {
        const { MapStage } = window.map;
        window.map.stage = new MapStage({
          view: { projection: "EPSG:3857", center: [0, 0], resolution: 1 },
          source: { url: "/scans/autzen.copc.laz" },
          layer: { style: { pointSize: 1 } },
          pixelRatio: ratio,
          projections,
        }) as MapStage;
      },
      [PROJECTIONS, RATIO] as const,
    );
  }, 280_000);
  afterAll(() => stage?.close());

  it("draws the scan where it is, in its colours", { timeout: 120_000 }, async () => {
    const extent = await stage.page.evaluate(async () => {
      const { stage } = window.map;
      await stage.source.opened();
      const [minX, minY, maxX, maxY] = stage.source.getExtent()!;
      await stage.show({
        projection: "EPSG:3857",
        center: [(minX + maxX) / 2, (minY + maxY) / 2],
        resolution: Math.max((maxX - minX) / 600, (maxY - minY) / 400),
      });
      return [minX, minY, maxX, maxY];
    });
    const lit = await stage.page.evaluate(() => window.map.stage.lit());
    await screenshot(stage.page, "map-autzen");
    expect(lit.length).toBeGreaterThan(48_000);
    // The picture of the points is as large as the scan: no less, and nothing of it lies elsewhere.
    const [minX, minY, maxX, maxY] = extent;
    const across = (maxX - minX) / Math.max((maxX - minX) / 600, (maxY - minY) / 400);
    const edges = lit.reduce(([low, high], [x]) => [Math.min(low, x), Math.max(high, x)], [1e9, -1]);
    const [left, right] = edges.map((x) => x / RATIO);
    expect(Math.abs(left - (300 - across / 2))).toBeLessThan(15);
    expect(Math.abs(right - (300 + across / 2))).toBeLessThan(15);
    expect(await stage.page.evaluate(() => window.map.stage.errors)).toEqual([]);
    expect(stage.watch.errors).toEqual([]);
  });

  it("draws finer levels the closer the map comes, and none that shows no more", {
    timeout: 120_000,
  }, async () => {
    const { points } = referee;
    const center = [0, 1].map(
      (axis) => points.reduce((sum, { "EPSG:32610": at }) => sum + at[axis]!, 0) / points.length,
    );
    const seen = await stage.page.evaluate(async (center) => {
      const { stage } = window.map;
      const found: (readonly [spacing: number, deepest: number])[] = [];
      for (const resolution of [8, 2, 0.5]) {
        await stage.show({ projection: "EPSG:32610", center, resolution });
        const { placed } = stage.layer.getRenderer() as never as {
          placed: {
            renderer: { content: { nodes: { count: number; node: { key: { depth: number } } }[] } };
            octree: { bounds: { spacing: number } };
          };
        };
        const depths = placed.renderer.content.nodes.flatMap(({ count, node }) =>
          count > 0 ? [node.key.depth] : [],
        );
        const deepest = Math.max(...depths);
        found.push([placed.octree.bounds.spacing / 2 ** deepest / resolution, deepest]);
      }
      return found;
    }, center);
    const deepest = seen.map(([, depth]) => depth);
    expect(new Set(deepest).size).toBe(3);
    expect(deepest).toEqual(deepest.toSorted((a, b) => a - b));
    // By default points lie 2 pixels of the canvas apart at most, and a level whose points do needs none below it: at 8 m and 2 m.
    for (const [pixels] of seen.slice(0, 2)) {
      expect(RATIO * pixels).toBeLessThanOrEqual(2);
      expect(RATIO * pixels).toBeGreaterThan(1);
    }
  });

  it.each(CODES.flatMap((code) => ROTATIONS.map((rotation) => [code, rotation] as const)))(
    "puts 100 points in %s, turned by %f, on PROJ's pixel",
    { timeout: 120_000 },
    async (code, rotation) => {
      const { points } = referee;
      expect(points.length).toBe(100);
      const places = points.map((point) => point[code]);
      const center = [0, 1].map((axis) => places.reduce((sum, at) => sum + at[axis], 0) / places.length);
      const scale = code === "EPSG:3857" ? 1 / Math.cos((44.055 * Math.PI) / 180) : 1;
      const resolution = (RESOLUTION * scale) / MAPS[code];
      const lit = await stage.page.evaluate(
        async (view) => {
          await window.map.stage.show(view);
          return window.map.stage.lit();
        },
        { projection: code, center, resolution, rotation },
      );
      if (rotation === 0.7) await screenshot(stage.page, `map-points-${code.slice(5)}`);
      const shown = new Set(lit.map(([x, y]) => `${x} ${y}`));
      const [cosine, sine] = [Math.cos(rotation), Math.sin(rotation)];
      /** Distance of PROJ's pixel from the middle of what the picture shows of the point, by the longer axis. */
      const offOf = (shift: number) =>
        places.flatMap(([x, y]) => {
          const [dx, dy] = [(x - center[0]) / resolution, (y - center[1]) / resolution];
          const [px, py] = [300 + cosine * dx + sine * dy + shift, 200 + sine * dx - cosine * dy];
          if (px < 5 || py < 5 || px > 595 || py > 395) return [];
          // No other point is as near as this.
          const reach = 3 * RATIO;
          const found: [number, number][] = [];
          for (let row = Math.floor(RATIO * py) - reach; row <= RATIO * py + reach; row++) {
            for (let column = Math.floor(RATIO * px) - reach; column <= RATIO * px + reach; column++) {
              if (shown.has(`${column} ${row}`)) found.push([column + 0.5, row + 0.5]);
            }
          }
          const middle = (axis: 0 | 1) => found.reduce((sum, at) => sum + at[axis], 0) / found.length / RATIO;
          return [found.length ? Math.max(Math.abs(middle(0) - px), Math.abs(middle(1) - py)) : 99];
        });
      const offs = offOf(0);
      expect(offs.length).toBeGreaterThan(60);
      // A quarter is what rounding to pixels of the canvas takes by itself, and the GPU knows places to 1/16 of them.
      expect(Math.max(...offs)).toBeLessThanOrEqual(0.3);
      // Two pixels beside it the same points are as far off: the picture tells where they are.
      expect(Math.min(...offOf(2))).toBeGreaterThan(1.5);
    },
  );
});

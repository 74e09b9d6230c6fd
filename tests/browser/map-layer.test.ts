import { afterAll, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { colourDifference, screenshot } from "./harness.js";
import type { StageOptions } from "./map-stage/map-stage.js";
import { openStage, type StagePage } from "./stage.js";

const UTM = { "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs" };
/** 20 × 20 m at 20 pixels per metre, in the plane of the scans. */
const ABOVE = { projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 0.05 };
/** Colours of the scan `stripes`, from west to east, 4 m each. */
const STRIPES = [
  [220, 40, 40],
  [40, 200, 60],
  [50, 80, 230],
  [240, 220, 60],
  [240, 240, 240],
];

describe.skipIf(pythonMissing)(
  `a layer of OpenLayers${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage("map-stage");
    }, 240_000);
    afterAll(() => stage?.close());
    beforeEach(() => stage.page.evaluate(() => window.map.stage?.destroy()));

    /** Sets a map up and waits until it is drawn. */
    const open = (cloud: string, { view = ABOVE, layer = {} }: Partial<StageOptions> = {}) => {
      const source = { url: `/clouds/${cloud}.copc.laz` };
      const options = { view, layer: { style: { pointSize: 3 }, ...layer }, source, projections: UTM };
      return stage.page.evaluate(async (text) => {
        const { MapStage } = window.map;
        window.map.stage = new MapStage(JSON.parse(text)) as typeof window.map.stage;
        await window.map.stage.complete();
      }, JSON.stringify(options));
    };

    /** RGBA of the layer's picture at a place in metres from the middle of the scan. */
    const colourAt = (east: number, north: number) =>
      stage.page.evaluate(
        ([x, y]) => {
          const { data, width } = window.map.stage.pixels();
          const at = 4 * (Math.round(y) * width + Math.round(x));
          return [...data.subarray(at, at + 4)];
        },
        [300 + 20 * east, 200 - 20 * north],
      );

    /** Changes the layer, and waits until that is drawn. */
    const change = async (properties: Record<string, unknown>) => {
      await stage.page.evaluate(async (given) => {
        Object.assign(window.map.stage.layer, given);
        await window.map.stage.complete();
      }, properties);
    };

    it("draws colours, attributes and classes, and what filters leave", { timeout: 120_000 }, async () => {
      await open("stripes");
      await screenshot(stage.page, "map-stripes");
      for (const [strip, colour] of STRIPES.entries()) {
        const shown = await colourAt(4 * strip - 8, 3);
        expect(colourDifference(shown, colour), `strip ${strip}: ${shown}`).toBeLessThan(3);
        expect(shown[3]).toBe(255);
      }
      // Beside the scan the map shows through.
      expect((await colourAt(11, 0))[3]).toBe(0);
      await change({ filter: { classes: [3, 5] } });
      expect(await Promise.all([-8, -4, 0, 4].map(async (east) => (await colourAt(east, 3))[3]))).toEqual([
        0, 255, 255, 0,
      ]);
      await change({ filter: undefined, style: { color: "intensity", gradient: "greyscale" } });
      const greys = await Promise.all([-8, -4, 0, 4, 8].map(async (east) => (await colourAt(east, 3))[0]!));
      expect(greys).toEqual([...greys].sort((a, b) => a - b));
      expect(greys[4]! - greys[0]!).toBeGreaterThan(150);
      expect(await stage.page.evaluate(() => window.map.stage.errors)).toEqual([]);
    });

    it("cuts and highlights by the same volumes as the globe, to a pixel", { timeout: 120_000 }, async () => {
      await open("stripes");
      await stage.page.evaluate(async () => {
        const { Clip } = window.map.layer;
        window.map.stage.layer.clips.add(
          Clip.polygon(
            [
              [499_995, 5_199_996],
              [500_005, 5_199_996],
              [500_005, 5_200_004],
              [499_995, 5_200_004],
            ],
            { coordinates: "source", mode: "inside" },
          ),
        );
        await window.map.stage.complete();
      });
      await screenshot(stage.page, "map-clip");
      const lit = await stage.page.evaluate(() => window.map.stage.lit());
      const range = (axis: 0 | 1) => [
        Math.min(...lit.map((at) => at[axis])),
        Math.max(...lit.map((at) => at[axis])),
      ];
      // Points stand every 2 pixels and are 3 wide; the box is 200 by 160 pixels.
      for (const [found, wanted] of [
        [range(0), [200, 400]],
        [range(1), [120, 280]],
      ] as const) {
        expect(Math.abs(found[0]! - wanted[0]!)).toBeLessThanOrEqual(3);
        expect(Math.abs(found[1]! - wanted[1]!)).toBeLessThanOrEqual(3);
      }
      await stage.page.evaluate(async () => {
        const { Clip } = window.map.layer;
        const { clips } = window.map.stage.layer;
        clips.clear();
        const center = { source: [500_000, 5_200_000, 500] as [number, number, number] };
        clips.add(Clip.box({ center, size: [4, 4, 4], mode: "highlight" }));
        window.map.stage.layer.style = { highlight: { color: [1, 0, 1], share: 1 } };
        await window.map.stage.complete();
      });
      await screenshot(stage.page, "map-highlight");
      expect(colourDifference(await colourAt(0, 0), [255, 0, 255])).toBeLessThan(3);
      expect(colourDifference(await colourAt(0, 3), STRIPES[2]!)).toBeLessThan(3);
    });

    it("shades relief, blends splats and lets the map through", { timeout: 120_000 }, async () => {
      await open("steps", { layer: { style: { pointSize: 4, eyeDomeLighting: true } } });
      await screenshot(stage.page, "map-eye-dome");
      // Along the block, which stands 4 m over the ground, the ground is darker than elsewhere.
      const [beside, away, top] = [await colourAt(4.12, 0), await colourAt(8, 0), await colourAt(0, 0)];
      expect(away[0]! - beside[0]!).toBeGreaterThan(20);
      expect(Math.abs(away[0]! - top[0]!)).toBeLessThan(8);
      const ran = () =>
        stage.page.evaluate(() => {
          const { ledger } = window.map.stage.layer;
          return ledger.filter(({ effect, active }) => effect === "eyeDomeLighting" && active).length;
        });
      expect(await ran()).toBe(1);
      await change({ style: { eyeDomeLighting: false } });
      expect(await ran()).toBe(0);
      expect(Math.abs((await colourAt(4.12, 0))[0]! - away[0]!)).toBeLessThan(8);
      await change({ style: { opacity: 0.5 } });
      expect(Math.abs((await colourAt(0, 0))[3]! - 128)).toBeLessThan(3);
      await change({ style: { opacity: 1, splats: true } });
      expect(colourDifference(await colourAt(0, 0), [128, 128, 128])).toBeLessThan(4);
      // Narrow splats are held against a copy of the depths as well.
      await change({ style: { pointSize: 2 } });
      expect(colourDifference(await colourAt(0, 0), [128, 128, 128])).toBeLessThan(4);
      const opacity = await stage.page.evaluate(async () => {
        const { stage } = window.map;
        stage.layer.setOpacity(0.25);
        await stage.complete();
        return stage.map.getViewport().querySelector("canvas")!.style.opacity;
      });
      expect(opacity).toBe("0.25");
    });

    it("picks the record that is drawn, by pixel and as a feature", { timeout: 120_000 }, async () => {
      await open("stripes");
      const found = await stage.page.evaluate(async () => {
        const { map, layer, source } = window.map.stage;
        const pixel = [300 + 20 * 2.5, 200 - 20 * 1.5];
        const picked = (await layer.pick(pixel))!;
        const [feature] = await layer.getFeatures(pixel);
        const sync = map.forEachFeatureAtPixel(pixel, (at) => at.getProperties(), { hitTolerance: 4 })!;
        const again = await source.cloud!.readPoint(sync.node, { record: sync.index });
        return {
          source: picked.source,
          coordinate: picked.coordinate,
          attributes: { ...picked.attributes },
          feature: feature?.get("record").integers,
          named: feature?.get("classification"),
          again: again.integers,
          integers: picked.integers,
          nothing: await layer.pick([5, 5]),
          none: map.hasFeatureAtPixel([5, 5]),
          colour: [...(layer.getData(pixel) as Uint8ClampedArray)],
        };
      });
      expect(Math.hypot(found.source[0] - 500_002.5, found.source[1] - 5_200_001.5)).toBeLessThan(0.15);
      // In the plane of the scan the place on the map is the record's own, but for float32.
      expect(
        Math.hypot(found.coordinate[0] - found.source[0], found.coordinate[1] - found.source[1]),
      ).toBeLessThan(1e-5);
      expect(found.attributes.classification).toBe(6);
      expect([found.feature, found.again, found.named]).toEqual([found.integers, found.integers, 6]);
      expect([found.nothing, found.none]).toEqual([undefined, false]);
      expect(colourDifference(found.colour, STRIPES[3]!)).toBeLessThan(3);
    });

    it("draws a view that stands still once, and the same picture again", { timeout: 120_000 }, async () => {
      await open("stripes");
      const seen = await stage.page.evaluate(async (above) => {
        const { stage, onPoints } = window.map;
        const first = stage.pixels().data;
        const { framesDrawn } = stage.layer.statistics;
        let calls = 0;
        const gl = stage.map.getViewport().querySelector("canvas")!.getContext("webgl2")!;
        gl.clear = (mask) => {
          calls++;
          WebGL2RenderingContext.prototype.clear.call(gl, mask);
        };
        onPoints(gl, (call) => {
          calls++;
          call.draw();
        });
        for (let frame = 0; frame < 5; frame++) {
          stage.map.render();
          await new Promise(requestAnimationFrame);
        }
        const still = [stage.layer.statistics.framesDrawn - framesDrawn, calls];
        await stage.show({ ...above, center: [500_003, 5_200_001], rotation: 1 });
        const other = stage.pixels().data;
        await stage.show(above);
        const again = stage.pixels().data;
        const same = (a: Uint8ClampedArray, b: Uint8ClampedArray) => a.every((value, at) => value === b[at]);
        return {
          still,
          calls,
          same: same(first, again),
          moved: !same(first, other),
          drawn: stage.layer.statistics,
        };
      }, ABOVE);
      expect([seen.still, seen.same, seen.moved]).toEqual([[0, 0], true, true]);
      // The other views were drawn by the calls that are counted.
      expect(seen.calls).toBeGreaterThan(2);
      expect(seen.drawn.pointsDrawn).toBeGreaterThan(30_000);
    });

    it("tells what it cannot draw by an event, and the map goes on", { timeout: 120_000 }, async () => {
      await open("stripes");
      const errors = await stage.page.evaluate(async (above) => {
        const { stage, ol } = window.map;
        const unknown = new ol.Projection({ code: "X:1", units: "m" });
        await stage.show({ ...above, projection: unknown as unknown as string });
        const first = [...stage.errors];
        ol.proj4.defs("X:2", "+proj=gnom +lat_0=-80 +lon_0=9 +ellps=WGS84");
        ol.register(ol.proj4);
        await stage.show({ ...above, projection: "X:2" });
        await stage.show(above);
        return { first, all: [...stage.errors], lit: stage.lit().length };
      }, ABOVE);
      expect(errors.first).toEqual(["CRS_PROJECTION"]);
      expect(errors.all).toEqual(["CRS_PROJECTION", "PLACE_MAP"]);
      expect(errors.lit).toBeGreaterThan(100_000);
      await stage.page.evaluate(() => window.map.stage.destroy());
      const missing = await stage.page.evaluate(
        async (options) => {
          const { MapStage } = window.map;
          window.map.stage = new MapStage(options) as typeof window.map.stage;
          await window.map.stage.source.opened().catch(() => undefined);
          await window.map.stage.complete();
          return { errors: window.map.stage.errors, state: window.map.stage.source.getState() };
        },
        { view: ABOVE, source: { url: "/clouds/none.copc.laz" }, projections: UTM },
      );
      expect(missing).toEqual({ errors: ["SOURCE_NOT_FOUND"], state: "error" });
      stage.watch.errors.length = 0;
    });

    it("draws the data set of another source before it is complete, and nothing of the one before", {
      timeout: 120_000,
    }, async () => {
      await open("stripes");
      const seen = await stage.page.evaluate(async () => {
        const { layer, stage } = window.map;
        const { source } = stage;
        /** Pixels with a colour, and without one. */
        const count = () => {
          if (!stage.map.getViewport().querySelector(".ol-layer canvas")) return [0, 0];
          const { data } = stage.pixels();
          const counts = [0, 0] as [number, number];
          for (let at = 0; at < data.length; at += 4) {
            if (data[at + 3]! > 0) counts[Math.abs(data[at]! - data[at + 1]!) > 30 ? 0 : 1]++;
          }
          return counts;
        };
        const found = [count()];
        const grey = new layer.PointCloudSource({ url: "/clouds/steps.copc.laz" });
        const later = new layer.PointCloudSource({ url: "/clouds/steps.copc.laz" });
        await grey.opened();
        for (const next of [grey, source, later, null, source]) {
          stage.layer.setSource(next);
          await stage.complete();
          found.push(count());
        }
        for (const one of [grey, later]) one.dispose();
        return found;
      });
      const [coloured, ...others] = seen;
      expect(coloured![0]).toBeGreaterThan(50_000);
      const [grey, back, later, none, again] = others;
      for (const [colours, greys] of [grey!, later!]) {
        expect(colours).toBe(0);
        expect(greys).toBeGreaterThan(100_000);
      }
      expect([back, none, again]).toEqual([coloured, [0, 0], coloured]);
      expect(stage.watch.errors).toEqual([]);
    });

    it("comes back as it was when the browser takes its context away", { timeout: 120_000 }, async () => {
      await open("stripes", { layer: { style: { pointSize: 3, eyeDomeLighting: true } } });
      const seen = await stage.page.evaluate(async () => {
        const { stage } = window.map;
        const before = stage.pixels().data;
        const canvas = stage.map.getViewport().querySelector<HTMLCanvasElement>("canvas")!;
        const lose = canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context")!;
        lose.loseContext();
        await new Promise((done) => setTimeout(done, 200));
        stage.map.render();
        // A map without its context neither throws nor finds a point.
        const found = await stage.layer.pick([300, 200]);
        lose.restoreContext();
        await new Promise((done) => setTimeout(done, 200));
        await stage.complete();
        const after = stage.pixels().data;
        const equal = before.every((value, at) => value === after[at]);
        return {
          equal,
          found,
          errors: stage.errors,
          picked: (await stage.layer.pick([300, 200])) !== undefined,
        };
      });
      expect(seen).toEqual({ equal: true, found: undefined, errors: [], picked: true });
    });

    it("frees all that it made when it is disposed of, or leaves the map", { timeout: 120_000 }, async () => {
      await open("steps", { layer: { style: { eyeDomeLighting: true, splats: true } } });
      const seen = await stage.page.evaluate(async () => {
        const { stage } = window.map;
        const { gpuObjects } = stage.layer.statistics;
        const objects = stage.layer.getRenderer() as unknown as {
          placed: {
            renderer: { objects: { counts: Record<string, number> } };
            octree: { stream: { bytes: number } };
          };
        };
        const { renderer, octree } = objects.placed;
        const before = Object.values(gpuObjects).reduce((sum, count) => sum + count, 0);
        const { Clip, SharedBudget } = window.map.layer;
        const { source } = stage;
        const budget = new SharedBudget();
        stage.layer.budget = budget;
        await stage.complete();
        const shared = [budget.granted > 0, budget.gpu.used > 0];
        const nameOf = (thrown: Error) => thrown.name;
        const onItsWay = stage.layer.pick([300, 200]).then(String, nameOf);
        stage.map.removeLayer(stage.layer);
        stage.layer.dispose();
        stage.source.dispose();
        const picks = [await onItsWay, await stage.layer.pick([300, 200]).then(String, nameOf)];
        // Whatever it was given has forgotten it.
        let changes = 0;
        stage.layer.changed = () => changes++;
        stage.layer.clips.add(Clip.box({ center: { source: [500_000, 5_200_000, 500] }, size: [4, 4, 4] }));
        budget.points = 5;
        source.changed();
        const found = [await stage.layer.getFeatures([300, 200]), stage.layer.getData([300, 200])];
        const after = Object.values(renderer.objects.counts).reduce((sum, count) => sum + count, 0);
        return {
          ...{ picks, found, changes, shared },
          kept: [budget.granted, budget.gpu.used, source.hasListener("change")],
          before,
          after,
          bytes: octree.stream.bytes,
          canvases: document.querySelectorAll("canvas").length,
        };
      });
      expect(seen.before).toBeGreaterThan(10);
      expect([seen.after, seen.bytes, seen.canvases]).toEqual([0, 0, 0]);
      expect(seen.picks).toEqual(["AbortError", "AbortError"]);
      expect(seen.found).toEqual([[], null]);
      expect([seen.shared, seen.kept, seen.changes]).toEqual([[true, true], [0, 0, false], 0]);
      expect(stage.watch.errors).toEqual([]);
    });
  },
);

import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { colourDifference, screenshot } from "./harness.js";
import { openStage, type StagePage } from "./stage.js";

const UTM = { "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs" };
/** 30 × 20 m at 20 pixels per metre around the scan `stripes`, of which each strip is 4 m wide. */
const ABOVE = { projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 0.05 };

describe.skipIf(pythonMissing)(
  `a layer of points as any layer of a map${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage("map-stage");
    }, 240_000);
    afterAll(() => stage?.close());

    /** Sets a map up and waits until it is drawn. */
    const open = (options: Record<string, unknown> = {}, pixelRatio = 1) =>
      stage.page.evaluate(
        async ({ view, projections, pixelRatio, options }) => {
          const { MapStage } = window.map;
          window.map.stage?.destroy();
          const source = { url: "/clouds/stripes.copc.laz" };
          const layer = { style: { pointSize: 3 }, ...options };
          const given = { view, projections, source, pixelRatio, layer };
          window.map.stage = new MapStage(given) as typeof window.map.stage;
          await window.map.stage.complete();
        },
        { view: ABOVE, projections: UTM, pixelRatio, options },
      );

    it("lies among tiles and vectors by its order, and lets them through by its opacity", {
      timeout: 120_000,
    }, async () => {
      await open({ zIndex: 1 });
      const shown = async (name: string) => {
        const colours = await stage.page.evaluate(async () => {
          await window.map.stage.complete();
          const { data, width } = window.map.stage.copy();
          // In the red strip, in the white one, and beside the scan.
          return [
            [300 - 160, 200],
            [300 + 160, 200],
            [550, 200],
          ].map(([x, y]) => [...data.slice(4 * (y! * width + x!), 4 * (y! * width + x!) + 3)]);
        });
        const seen = await screenshot(stage.page, name);
        // What a print copies is what the screen shows.
        for (const [at, x] of [140, 460, 550].entries()) {
          const begin = 4 * (200 * seen.width + x);
          expect(colourDifference(seen.data.subarray(begin, begin + 3), colours[at]!)).toBeLessThan(3);
        }
        return colours;
      };
      await stage.page.evaluate(() => {
        const { ol, stage } = window.map;
        const canvas = document.createElement("canvas");
        Object.assign(canvas, { width: 256, height: 256 });
        const context = canvas.getContext("2d")!;
        context.fillStyle = "rgb(20, 120, 200)";
        context.fillRect(0, 0, 256, 256);
        const source = new ol.XYZ({ url: canvas.toDataURL(), projection: "EPSG:32632", maxZoom: 3 });
        const tiles = new ol.TileLayer({ source, zIndex: 0 });
        tiles.getSource()!.setState("ready");
        const east = new ol.Feature(ol.fromExtent([500_000, 5_199_990, 500_015, 5_200_010]));
        const vectors = new ol.VectorLayer({
          source: new ol.VectorSource({ features: [east] }),
          style: new ol.Style({ fill: new ol.Fill({ color: "rgb(255, 0, 255)" }) }),
          zIndex: 2,
        });
        stage.map.addLayer(tiles);
        stage.map.addLayer(vectors);
      });
      const [red, white] = [
        [220, 40, 40],
        [240, 240, 240],
      ];
      const magenta = [255, 0, 255];
      const over = await shown("map-order-over");
      for (const [at, wanted] of [red, magenta, magenta].entries()) {
        expect(colourDifference(over[at]!, wanted!), `${over}`).toBeLessThan(4);
      }
      await stage.page.evaluate(() => window.map.stage.layer.setZIndex(3));
      const under = await shown("map-order-under");
      for (const [at, wanted] of [red, white, magenta].entries()) {
        expect(colourDifference(under[at]!, wanted!), `${under}`).toBeLessThan(4);
      }
      await stage.page.evaluate(() => window.map.stage.layer.setOpacity(0.5));
      const through = await shown("map-order-through");
      const half = (a: number[], b: number[]) => a.map((value, at) => (value + b[at]!) / 2);
      for (const [at, wanted] of [half(red, [20, 120, 200]), half(white, magenta), magenta].entries()) {
        expect(colourDifference(through[at]!, wanted), `${through}`).toBeLessThan(5);
      }
      expect(stage.watch.errors).toEqual([]);
    });

    it("has a source that tells its state, who made it, and its outline in the map's projection", {
      timeout: 120_000,
    }, async () => {
      const seen = await stage.page.evaluate(
        async ({ view, projections }) => {
          const { MapStage, ol } = window.map;
          window.map.stage?.destroy();
          const response = await fetch("/clouds/stripes.copc.laz");
          const file = new File([await response.arrayBuffer()], "stripes.copc.laz");
          const source = { file, attributions: "Surveyed by us" };
          window.map.stage = new MapStage({ view, projections, source }) as typeof window.map.stage;
          const { stage } = window.map;
          const states = [String(stage.source.getState())];
          stage.source.on("change", () => states.push(String(stage.source.getState())));
          stage.map.addLayer(new ol.VectorLayer({ source: stage.source.footprint }));
          await stage.source.opened();
          await stage.complete();
          const outline = () => {
            const [feature, ...others] = stage.source.footprint.getFeatures();
            return { name: feature?.get("name"), extent: feature?.getGeometry()?.getExtent(), others };
          };
          const found = [outline()];
          const extent = stage.source.getExtent("EPSG:3857")!;
          await stage.show({ projection: "EPSG:3857", center: extent.slice(0, 2), resolution: 0.2 });
          found.push(outline());
          const frame = stage.map as unknown as { frameState_: never };
          const attributions = stage.source.getAttributions()?.(frame.frameState_);
          return { states: [...new Set(states)], found, extent, attributions };
        },
        { view: ABOVE, projections: UTM },
      );
      await screenshot(stage.page, "map-footprint");
      expect(seen.states).toEqual(["loading", "ready"]);
      expect(seen.attributions).toEqual(["Surveyed by us"]);
      const [utm, mercator] = seen.found;
      for (const { name, others } of seen.found) expect([name, others]).toEqual(["stripes.copc.laz", []]);
      for (const [at, edge] of [499_990, 5_199_990, 500_010, 5_200_010].entries()) {
        expect(Math.abs(utm!.extent![at]! - edge)).toBeLessThan(0.06);
      }
      expect(mercator!.extent).toEqual(seen.extent);
    });

    it("has one source and one outline on maps of several projections, each of which comes to rest", {
      timeout: 120_000,
    }, async () => {
      await open();
      const seen = await stage.page.evaluate(async () => {
        const { layer, ol, stage } = window.map;
        const outlines = () => new ol.VectorLayer({ source: stage.source.footprint });
        stage.map.addLayer(outlines());
        const mercator = stage.source.getExtent("EPSG:3857")!;
        const target = stage.map.getTargetElement()!.cloneNode() as HTMLElement;
        document.body.append(target);
        const points = new layer.PointCloudLayer({ source: stage.source, style: { pointSize: 3 } });
        const view = new ol.View({ center: [0, 0], resolution: 1 });
        const options = { target, controls: [], interactions: [], layers: [points, outlines()], view };
        const other = new ol.OlMap(options);
        view.fit(mercator, { padding: [20, 20, 20, 20] });
        // A map in a projection that nothing knows shows no outline, and goes on.
        const nowhere = new ol.OlMap({
          ...{ target: target.cloneNode() as HTMLElement, layers: [outlines()] },
          view: new ol.View({ projection: new ol.Projection({ code: "X:9" }), center: [0, 0], zoom: 1 }),
        });
        document.body.append(nowhere.getTargetElement()!);
        const maps = [stage.map, other, nowhere];
        const complete = async () => {
          for (const map of maps) {
            await new Promise<void>((resolve) => {
              map.once("rendercomplete", () => resolve());
              map.render();
            });
          }
        };
        await complete();
        await complete();
        const frames = [0, 0, 0];
        for (const [at, map] of maps.entries()) map.on("postrender", () => frames[at]!++);
        await new Promise((done) => setTimeout(done, 500));
        const resting = [...frames];
        // Both are drawn anew, and find the outline where each of them has it.
        await complete();
        const extents = maps.map((map) => {
          const geometry = { extent: undefined as number[] | undefined };
          const [width, height] = map.getSize()!;
          for (let x = 0; x < width! / 2 && !geometry.extent; x++) {
            const outline = (feature: { getGeometry(): unknown }) => {
              geometry.extent = (feature.getGeometry() as { getExtent(): number[] }).getExtent();
            };
            const layerFilter = (one: unknown) => one !== points && one !== stage.layer;
            map.forEachFeatureAtPixel([x, height! / 2], outline, { layerFilter });
          }
          return geometry.extent;
        });
        const drawn = [stage.layer, points].map((one) => one.statistics.pointsDrawn);
        const utm = stage.source.getExtent("EPSG:32632")!;
        for (const map of [other, nowhere]) {
          map.getTargetElement()!.remove();
          map.dispose();
        }
        points.dispose();
        return { resting, extents, wanted: [utm, mercator, undefined], drawn };
      });
      expect(seen.resting).toEqual([0, 0, 0]);
      expect(seen.extents).toEqual(seen.wanted);
      expect(seen.drawn[0]).toBeGreaterThan(30_000);
      expect(seen.drawn[1]).toBe(seen.drawn[0]);
      expect(stage.watch.errors).toEqual([]);
    });

    it("shows at the zooms that it is given, in an element of its class", { timeout: 120_000 }, async () => {
      await open({ className: "scan", minZoom: 17, maxZoom: 18 });
      const seen = await stage.page.evaluate(async () => {
        const { stage } = window.map;
        const view = stage.map.getView();
        const found: unknown[] = [];
        for (const zoom of [16.9, 17.5, 18.1, 17.5]) {
          view.setResolution(view.getResolutionForZoom(zoom));
          await stage.complete();
          const canvas = stage.map.getViewport().querySelector(".scan canvas");
          found.push([canvas !== null, (await stage.layer.pick([300, 200])) !== undefined]);
        }
        stage.layer.setVisible(false);
        await stage.complete();
        found.push(stage.map.getViewport().querySelector(".scan canvas") !== null);
        return found;
      });
      const [shown, hidden] = [
        [true, true],
        [false, false],
      ];
      expect(seen).toEqual([hidden, shown, hidden, shown, false]);
      expect(stage.watch.errors).toEqual([]);
    });

    it("shows a scan on 180° in one piece, whichever world the map shows", { timeout: 120_000 }, async () => {
      const errors: string[] = [];
      for (const [world, projection] of [
        [0, "EPSG:3857"],
        [-1, "EPSG:3857"],
        [1, "EPSG:4326"],
      ] as const) {
        await stage.page.evaluate(() => window.map.stage?.destroy());
        const seen = await stage.page.evaluate(
          async ([turn, code]) => {
            const { MapStage } = window.map;
            const metres = code === "EPSG:3857";
            // The middle of the scan lies 20 m west of 180°; at 47° Mercator's metre is 0.68 m of ground.
            const [edge, y] = metres ? [20037508.342789244, 5_935_000] : [180, 46.95];
            const view = {
              projection: code as string,
              center: [edge * (1 + 2 * (turn as number)), y as number],
            };
            const resolution = metres ? 0.1 : 0.1 / 111_000;
            const crs =
              "+proj=tmerc +lat_0=0 +lon_0=180 +k=0.9996 +x_0=500000 +y_0=0 +datum=WGS84 +units=m +no_defs";
            const source = { url: "/clouds/stripes.copc.laz", crs };
            const options = { view: { ...view, resolution }, layer: { style: { pointSize: 3 } }, source };
            window.map.stage = new MapStage(options) as typeof window.map.stage;
            const { stage } = window.map;
            await stage.source.opened();
            const [minX, minY, maxX, maxY] = stage.source.getExtent(code as string)!;
            const middle = [edge * (1 + 2 * (turn as number)), (minY + maxY) / 2];
            await stage.show({ ...view, center: middle, resolution });
            const columns = stage.lit().map(([x]) => x);
            // What is picked on either side of 180° lies where it was picked, in the world that the map shows.
            const off: number[] = [];
            for (const pixel of [
              [240, 200],
              [360, 200],
            ] as const) {
              const found: (readonly number[])[] = [(await stage.layer.pick(pixel))?.coordinate ?? []];
              for (const one of await stage.layer.getFeatures([...pixel])) found.push(placeOf(one));
              stage.map.forEachFeatureAtPixel([...pixel], (one) => void found.push(placeOf(one)));
              for (const place of found) {
                const [x, y] = stage.map.getPixelFromCoordinate([...place]) ?? [Infinity, Infinity];
                off.push(Math.hypot(x! - pixel[0]!, y! - pixel[1]!));
              }
            }
            function placeOf(feature: { getGeometry(): unknown }): number[] {
              return (feature.getGeometry() as { getCoordinates(): number[] }).getCoordinates();
            }
            return {
              off,
              ...{ lit: columns.length, left: Math.min(...columns), right: Math.max(...columns) },
              ...{ errors: stage.errors, width: (maxX - minX) * (metres ? 1 : 111_320) },
            };
          },
          [world, projection] as const,
        );
        errors.push(...seen.errors);
        // 20 m, as long as a map at 47° shows them.
        expect(seen.width).toBeGreaterThan(28);
        expect(seen.width).toBeLessThan(31);
        // Both halves, and the middle of the scan in the middle of the map.
        expect(seen.lit).toBeGreaterThan(20_000);
        expect(Math.abs(seen.left + seen.right - 600)).toBeLessThan(8);
        expect(seen.right - seen.left).toBeGreaterThan(180);
        expect(seen.off).toHaveLength(6);
        for (const pixels of seen.off) expect(pixels).toBeLessThan(5);
      }
      await screenshot(stage.page, "map-antimeridian");
      expect(errors).toEqual([]);
    });

    it("is printed in as many pixels as are asked for, all of it, and only within its extent", {
      timeout: 120_000,
    }, async () => {
      await open();
      const once = await stage.page.evaluate(() => window.map.stage.lit().length);
      await open({}, 2.5);
      const seen = await stage.page.evaluate(async () => {
        const { stage } = window.map;
        const bounds = ({ data, width, height }: ImageData) => {
          const lit: [number, number][] = [];
          for (let at = 3; at < data.length; at += 4) {
            if (data[at]! > 0) lit.push([((at - 3) / 4) % width, Math.floor((at - 3) / 4 / width)]);
          }
          const range = (axis: 0 | 1) =>
            lit.reduce(([low, high], at) => [Math.min(low!, at[axis]), Math.max(high!, at[axis])], [1e9, -1]);
          return { width, height, lit: lit.length, x: range(0), y: range(1) };
        };
        const full = bounds(stage.copy());
        // What is complete shows all that the view wants.
        const { nodesVisible, nodesLoaded } = stage.layer.statistics;
        stage.layer.setExtent([499_995, 5_199_996, 500_005, 5_200_004]);
        await stage.complete();
        const within = bounds(stage.copy());
        // 6 m to the east there are points, but not within the extent.
        const picked = [
          (await stage.layer.pick([300, 200])) !== undefined,
          (await stage.layer.pick([420, 200])) !== undefined,
          stage.map.hasFeatureAtPixel([420, 200]),
        ];
        // A print on paper: a larger map for a moment, at as many metres.
        const view = stage.map.getView();
        stage.layer.setExtent(undefined);
        view.setRotation(0.3);
        const printed = new Promise<ReturnType<typeof bounds>>((resolve) => {
          stage.map.once("rendercomplete", () => resolve(bounds(stage.copy())));
        });
        stage.map.setSize([1200, 800]);
        view.setResolution(0.025);
        const paper = await printed;
        const all = stage.layer.statistics;
        return { full, nodes: [nodesVisible, nodesLoaded], within, picked, paper, all };
      });
      await screenshot(stage.page, "map-print");
      expect([seen.full.width, seen.full.height]).toEqual([1500, 1000]);
      expect(seen.nodes[0]).toBe(seen.nodes[1]);
      expect(Math.abs(seen.full.lit / once / 2.5 ** 2 - 1)).toBeLessThan(0.03);
      // 10 by 8 metres around the middle, at 50 pixels per metre, to a pixel; points that reach over are cut.
      for (const [found, wanted] of [
        [seen.within.x, [500, 999]],
        [seen.within.y, [300, 699]],
      ] as const) {
        expect(Math.abs(found[0]! - wanted[0]!)).toBeLessThanOrEqual(1);
        expect(Math.abs(found[1]! - wanted[1]!)).toBeLessThanOrEqual(1);
      }
      expect(seen.picked).toEqual([true, false, false]);
      expect([seen.paper.width, seen.paper.height]).toEqual([3000, 2000]);
      expect(seen.all.nodesLoaded).toBe(seen.all.nodesVisible);
      // 20 by 20 metres at 100 pixels per metre: points 10 pixels apart and 7.5 wide.
      const share = Math.round(7.5) ** 2 / 10 ** 2;
      expect(Math.abs(seen.paper.lit / (share * 2000 ** 2) - 1)).toBeLessThan(0.2);
      expect(stage.watch.errors).toEqual([]);
    });
  },
);

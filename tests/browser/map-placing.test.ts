import { afterAll, beforeAll, beforeEach, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { screenshot } from "./harness.js";
import { openStage, type StagePage } from "./stage.js";

const UTM = { "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs" };
/** 20 × 20 m at 20 pixels per metre, in the plane of the scan `stripes`. */
const ABOVE = { projection: "EPSG:32632", center: [500_000, 5_200_000], resolution: 0.05 };

describe.skipIf(pythonMissing)(
  `what a map's points are placed for${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage("map-stage");
    }, 240_000);
    afterAll(() => stage?.close());
    beforeEach(() => stage.page.evaluate(() => window.map.stage?.destroy()));

    it("keeps the old picture until the points are placed in another projection, and reads nothing again", {
      timeout: 120_000,
    }, async () => {
      await stage.page.evaluate(
        async ({ view, projections }) => {
          const { MapStage } = window.map;
          const source = { url: "/clouds/stripes.copc.laz" };
          const layer = { style: { pointSize: 3 } };
          window.map.stage = new MapStage({ view, projections, source, layer }) as never;
          await window.map.stage.complete();
        },
        { view: ABOVE, projections: UTM },
      );
      let requests = 0;
      const count = () => requests++;
      stage.page.on("request", count);
      const seen = await stage.page.evaluate(async () => {
        const { stage } = window.map;
        const [x, y] = stage.source.getExtent("EPSG:3857")!;
        let showing = true;
        const shown = stage
          .show({ projection: "EPSG:3857", center: [x + 14, y + 14], resolution: 0.07 })
          .finally(() => {
            showing = false;
          });
        const lit: number[] = [];
        while (showing) {
          await new Promise(requestAnimationFrame);
          lit.push(stage.lit().length);
        }
        await shown;
        return { old: Math.min(...lit), lit: stage.lit().length, errors: stage.errors };
      });
      stage.page.off("request", count);
      await screenshot(stage.page, "map-mercator");
      expect(seen.old).toBeGreaterThan(100_000);
      expect(seen.lit).toBeGreaterThan(100_000);
      expect(seen.errors).toEqual([]);
      expect(requests).toBe(0);
    });

    it("places the points anew for a view that comes closer, behind the old picture", {
      timeout: 120_000,
    }, async () => {
      await stage.page.evaluate(async () => {
        const { MapStage, ol } = window.map;
        // A scan of 200 m, as if its coordinates were decametres: an affine map is off by a millimetre there.
        const crs =
          "+proj=tmerc +lat_0=47 +lon_0=9 +k=1 +x_0=5000000 +y_0=52000000 +datum=WGS84 +to_meter=10 +no_defs";
        const view = { projection: "EPSG:3857", center: [0, 0], resolution: 1 };
        const source = { url: "/clouds/stripes.copc.laz", crs, tolerance: 0.01 };
        window.map.stage = new MapStage({ view, source, layer: { style: { pointSize: 3 } } }) as never;
        const { stage } = window.map;
        await stage.source.opened();
        const [minX, minY, maxX, maxY] = stage.source.getExtent("EPSG:3857")! as number[];
        const center = [(minX! + maxX!) / 2, (minY! + maxY!) / 2];
        const viewTo = (minResolution: number) =>
          new ol.View({ projection: "EPSG:3857", center, resolution: 1, minResolution, maxResolution: 1e4 });
        stage.map.setView(viewTo(1));
        await stage.complete();
        (window as never as { viewTo: typeof viewTo }).viewTo = viewTo;
      });
      /** Greatest certified distance from the exact places, millimetres, and how many pixels showed points at least. */
      const approach = (minResolution: number) =>
        stage.page.evaluate(async (finest) => {
          const { stage } = window.map;
          const { viewTo } = window as never as { viewTo(finest: number): never };
          let showing = true;
          stage.map.setView(viewTo(finest));
          const shown = stage.complete().finally(() => {
            showing = false;
          });
          const lit: number[] = [];
          while (showing) {
            await new Promise(requestAnimationFrame);
            lit.push(stage.lit().length);
          }
          await shown;
          const { placed } = stage.layer.getRenderer() as never as {
            placed: { renderer: { content: { nodes: { uploaded: { vertices: { bound: number } } }[] } } };
          };
          const bounds = placed.renderer.content.nodes.map(({ uploaded }) => uploaded.vertices.bound);
          return { bound: 1000 * Math.max(...bounds), lit: Math.min(...lit), now: stage.lit().length };
        }, minResolution);
      let requests = 0;
      const count = () => requests++;
      stage.page.on("request", count);
      const far = await approach(0.5);
      const near = await approach(0.001);
      const back = await approach(1);
      stage.page.off("request", count);
      // A tenth of a pixel of 1 m is more than the layer's tolerance, which holds then.
      expect(far.bound).toBeGreaterThan(0.1);
      expect(far.bound).toBeLessThan(10);
      expect(near.bound).toBeLessThan(0.1);
      expect(back.bound).toBe(near.bound);
      expect(near.lit).toBe(far.now);
      expect(near.now).toBe(far.now);
      expect(requests).toBe(0);
    });

    it("shows nothing beyond the edge of Mercator's world, and tells of it once", {
      timeout: 120_000,
    }, async () => {
      const seen = await stage.page.evaluate(async () => {
        const { MapStage } = window.map;
        // The southern half of the scan lies before the edge.
        const crs =
          "+proj=tmerc +lat_0=85.0511287798066 +lon_0=9 +k=1 +x_0=500000 +y_0=5200000 +datum=WGS84 +no_defs";
        const [x, y] = [(9 / 180) * 20037508.342789244, 20037508.342789244];
        const view = { projection: "EPSG:3857", center: [x, y], resolution: 1 };
        const source = { url: "/clouds/stripes.copc.laz", crs };
        window.map.stage = new MapStage({ view, source, layer: { style: { pointSize: 3 } } }) as never;
        const { stage } = window.map;
        await stage.source.opened();
        await stage.complete();
        const rows = () => stage.lit().map(([, row]) => row);
        const found = { before: rows(), errors: [...stage.errors] };
        const picks = [await stage.layer.pick([300, 190]), await stage.layer.pick([300, 210])];
        // Nor within an extent of the layer that goes on beyond it, nor in one that lies there.
        const within = async (extent: number[]) => {
          stage.layer.setExtent(extent);
          await stage.complete();
          return rows();
        };
        const across = await within([x, y - 50, x + 200, y + 50]);
        const beyond = await within([x - 200, y + 20, x + 200, y + 50]);
        stage.layer.setExtent(undefined);
        // Where the map has the place, all of the scan shows.
        const degrees = view.resolution / 10 / 111_000;
        await stage.show({ projection: "EPSG:4326", center: [9, 85.0511287798066], resolution: degrees });
        return {
          ...{ ...found, picks: picks.map((pick) => pick !== undefined), across, beyond },
          ...{ whole: rows(), after: stage.errors },
        };
      });
      await screenshot(stage.page, "map-world-edge");
      expect(seen.before.length).toBeGreaterThan(20_000);
      expect(Math.min(...seen.before)).toBe(200);
      expect(seen.errors).toEqual(["PLACE_MAP"]);
      expect(seen.picks).toEqual([false, true]);
      expect([Math.min(...seen.across), Math.max(...seen.across)]).toEqual([200, 249]);
      expect(seen.beyond).toEqual([]);
      expect(Math.min(...seen.whole)).toBeLessThan(120);
      expect(seen.after).toEqual(["PLACE_MAP"]);
    });

    it("tells of a pole in Mercator's projection and of a browser without WebGL 2, and the map goes on", {
      timeout: 120_000,
    }, async () => {
      const seen = await stage.page.evaluate(
        async ({ above, projections }) => {
          const { MapStage } = window.map;
          const crs =
            "+proj=stere +lat_0=90 +lon_0=0 +k=1 +x_0=500000 +y_0=5200000 +datum=WGS84 +units=m +no_defs";
          const pole = { projection: "EPSG:3857", center: [0, 2e7], resolution: 1000 };
          const source = { url: "/clouds/stripes.copc.laz", crs };
          window.map.stage = new MapStage({ view: pole, source }) as typeof window.map.stage;
          await window.map.stage.source.opened();
          await window.map.stage.complete();
          const mercator = window.map.stage.errors;
          // Where the map is polar, the same scan shows.
          window.map.ol.proj4.defs("X:3", "+proj=stere +lat_0=90 +lon_0=0 +k=1 +datum=WGS84 +units=m");
          window.map.ol.register(window.map.ol.proj4);
          await window.map.stage.show({ projection: "X:3", center: [0, 0], resolution: 0.05 });
          const lit = window.map.stage.lit().length;
          window.map.stage.destroy();
          const { getContext } = HTMLCanvasElement.prototype;
          // biome-ignore lint/suspicious/noExplicitAny: a browser without WebGL 2
          (HTMLCanvasElement.prototype as any).getContext = function (kind: string, options: unknown) {
            return kind === "webgl2" ? null : Reflect.apply(getContext, this, [kind, options]);
          };
          try {
            const plain = { view: above, projections, source: { url: "/clouds/stripes.copc.laz" } };
            window.map.stage = new MapStage(plain) as typeof window.map.stage;
            await window.map.stage.source.opened();
            await window.map.stage.complete();
            await window.map.stage.complete();
          } finally {
            HTMLCanvasElement.prototype.getContext = getContext;
          }
          return { mercator, lit, without: window.map.stage.errors };
        },
        { above: ABOVE, projections: UTM },
      );
      expect(seen.mercator).toEqual(["PLACE_MAP"]);
      expect(seen.lit).toBeGreaterThan(100_000);
      expect(seen.without).toEqual(["DRAW_WEBGL2"]);
    });

    it("asks anew for nodes that failed, although it stands still", { timeout: 120_000 }, async () => {
      let gone = true;
      // What is more than ten thousand bytes are points.
      await stage.page.route("**/clouds/stripes.copc.laz", (route) => {
        const [first, last] = route.request().headers().range!.slice("bytes=".length).split("-").map(Number);
        return gone && last! - first! > 10_000 ? route.fulfill({ status: 404 }) : route.continue();
      });
      const options = {
        view: ABOVE,
        source: { url: "/clouds/stripes.copc.laz", headLength: 1024 },
        projections: UTM,
      };
      await stage.page.evaluate(async (text) => {
        const { MapStage } = window.map;
        window.map.stage = new MapStage(JSON.parse(text)) as typeof window.map.stage;
        await window.map.stage.complete();
      }, JSON.stringify(options));
      const counts = () =>
        stage.page.evaluate(() => {
          const { nodesVisible, nodesLoaded, nodesFailed } = window.map.stage.layer.statistics;
          return { nodesVisible, nodesLoaded, nodesFailed };
        });
      await expect.poll(counts).toEqual({ nodesVisible: 1, nodesLoaded: 0, nodesFailed: 1 });
      expect(await stage.page.evaluate(() => window.map.stage.errors)).toEqual(["SOURCE_NOT_FOUND"]);
      gone = false;
      await stage.page.evaluate(() => window.map.stage.layer.retryFailed());
      await expect.poll(counts).toEqual({ nodesVisible: 1, nodesLoaded: 1, nodesFailed: 0 });
      await stage.page.unroute("**/clouds/stripes.copc.laz");
      stage.watch.errors.length = 0;
    });
  },
);

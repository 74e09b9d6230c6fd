import { afterAll, afterEach, beforeAll, expect } from "vitest";
import { pythonMissing } from "../python.js";
import { openStage, type StagePage } from "./stage.js";

/** Why there is no scan to link views with, if so, and what a test says then. */
export const missing = pythonMissing;
export const unless = pythonMissing ? ` (skipped: ${pythonMissing})` : "";

/** Projections beside those of OpenLayers. */
const PROJECTIONS = {
  "EPSG:32632": "+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs",
  "EPSG:3413": "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +k=1 +datum=WGS84 +units=m +no_defs",
  "EPSG:3031": "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=0 +k=1 +datum=WGS84 +units=m +no_defs",
};

/** Middle of the scans, in the plane of EPSG:32632. */
export const MIDDLE = [500_000, 5_200_000] as const;

/** Where a map and a globe lie in the page: CSS pixels of their upper left corners. */
export interface Boxes {
  readonly map: readonly [number, number];
  readonly globe: readonly [number, number];
}

/** A page with a globe and maps that show a scan, for all tests of a file: each leaves neither maps nor a link behind. */
export class LinkedPage {
  #stage: StagePage | undefined;

  constructor() {
    beforeAll(async () => {
      this.#stage = await openStage("link-stage");
      await this.page.evaluate(async (projections) => {
        const { ol, PointCloud, LinkStage } = window.linked;
        for (const [code, definition] of Object.entries(projections)) ol.proj4.defs(code, definition);
        ol.register(ol.proj4);
        const cloud = await PointCloud.fromUrl("/clouds/stripes.copc.laz", { workers: { size: 1 } });
        window.linked.stage = new LinkStage(cloud) as typeof window.linked.stage;
      }, PROJECTIONS);
    }, 240_000);
    afterAll(() => this.#stage?.close());
    afterEach(async () => {
      await this.page.evaluate(() => {
        const { linked } = window;
        linked.link?.dispose();
        linked.stage.halt();
        for (const map of linked.stage.maps.splice(0)) map.destroy();
      });
      expect(this.#stage!.watch.errors).toEqual([]);
    });
  }

  get page(): StagePage["page"] {
    return this.#stage!.page;
  }

  get mouse() {
    return this.page.mouse;
  }

  /** Has a globe and a map show the scan, and links them; the globe draws frames until the test ends. */
  show(options: Record<string, unknown>): Promise<Boxes> {
    return this.page.evaluate(async (given) => {
      const { stage, synchronize } = window.linked;
      const map = stage.addMap({
        projection: "EPSG:32632",
        center: [500_000, 5_200_000],
        resolution: 0.05,
      });
      stage.globe.look({ at: [500_000, 5_200_000, 500], heading: 20, pitch: -70, range: 25 });
      await stage.globe.settle();
      await map.complete();
      const link = synchronize({ viewer: stage.globe.widget, map: map.map, view: "none", ...given });
      window.linked.link = link;
      await map.complete();
      map.map.getTargetElement()!.scrollIntoView();
      const box = (element: Element) => {
        const { left, top } = element.getBoundingClientRect();
        return [left, top] as const;
      };
      stage.run();
      return { map: box(map.map.getViewport()), globe: box(stage.globe.scene.canvas) };
    }, options);
  }

  /** Waits until something holds in the page. */
  async until<Given>(holds: (given: Given) => unknown, given: Given): Promise<void> {
    await this.page.waitForFunction(holds as () => unknown, given, { polling: 20, timeout: 60_000 });
  }
}

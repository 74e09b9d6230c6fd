import { geodeticToEcef } from "@groma/georef";
import type { PointCloudLayer } from "@groma/layer/cesium";
import type { PointNavigation } from "@groma/layer/navigation";
import type { MeasureTool, PlotView, ProfilePoints, ViewAdapter } from "@groma/layer/tools";
import type { Cartesian3, Viewer } from "cesium";
import type OlMap from "ol/Map.js";
import type { Page } from "playwright-core";

/** What the page offers to tests once a cloud is open: `window.groma` of demo/src/page-global.ts. */
export interface Groma {
  readonly viewer: Viewer;
  readonly navigation: PointNavigation;
  readonly beside: {
    readonly statistics: { readonly pointsDrawn: number } | undefined;
    readonly view: Promise<{ readonly map: OlMap; readonly measured: ViewAdapter }> | undefined;
  };
  readonly layer: PointCloudLayer;
  readonly clouds: { readonly layers: readonly PointCloudLayer[] };
  readonly measure: MeasureTool;
  /** The panel of demo/src/profile. */
  readonly profile: {
    readonly line: readonly (readonly [number, number])[];
    readonly shown: number;
    readonly plot:
      | {
          readonly view: PlotView;
          readonly parts: readonly Pick<ProfilePoints, "chainage" | "height">[];
        }
      | undefined;
  };
}

declare global {
  interface Window {
    readonly groma: Groma;
  }
}

/** A Cartesian3 as it crosses to the page: Cesium takes any object with x, y and z. */
type Point = Pick<Cartesian3, "x" | "y" | "z">;

/** ECEF (metres) of a place given in degrees and metres above the ellipsoid. */
export function ecef(longitudeDegrees: number, latitudeDegrees: number, height: number): Point {
  const out = new Float64Array(3);
  geodeticToEcef((longitudeDegrees * Math.PI) / 180, (latitudeDegrees * Math.PI) / 180, height, out);
  return { x: out[0]!, y: out[1]!, z: out[2]! };
}

/** Looks straight down from `destination` (ECEF, metres), north up, and waits until all that the view wants is drawn. */
export async function lookDown(page: Page, destination: Point): Promise<void> {
  await page.evaluate((to) => {
    const { viewer } = window.groma;
    viewer.camera.setView({
      destination: to as Cartesian3,
      orientation: { heading: 0, pitch: -Math.PI / 2, roll: 0 },
    });
    viewer.scene.requestRender();
  }, destination);
  await settle(page);
}

/** Waits until the layer has drawn everything that the current view wants. */
export async function settle(page: Page): Promise<void> {
  await page.waitForFunction(() => window.groma?.layer?.settled === true, undefined, {
    timeout: 180_000,
    polling: 200,
  });
}

/** Hides the cloud, and waits until the globe is drawn whole without it. */
export async function hideCloud(page: Page): Promise<void> {
  await page.evaluate(() => {
    const { layer, viewer } = window.groma;
    layer.show = false;
    return new Promise<void>((done) => {
      const stop = viewer.scene.postRender.addEventListener(() => {
        const { globe } = viewer.scene;
        if (globe.show && !globe.tilesLoaded) return viewer.scene.requestRender();
        stop();
        done();
      });
      viewer.scene.requestRender();
    });
  });
}

/** Canvas pixel of an ECEF position, by Cesium. */
export async function pixelOf(page: Page, position: Point): Promise<{ x: number; y: number }> {
  const pixel = await page.evaluate((at) => {
    const found = window.groma.viewer.scene.cartesianToCanvasCoordinates(at as Cartesian3);
    return found && { x: found.x, y: found.y };
  }, position);
  if (!pixel) throw new Error("the place is not in front of the camera");
  return pixel;
}

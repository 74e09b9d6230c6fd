import {
  buildModuleUrl,
  CesiumTerrainProvider,
  ImageryLayer,
  Resource,
  ScreenSpaceEventType,
  TileMapServiceImageryProvider,
  Viewer,
} from "cesium";
import { i18n } from "./language/i18n.js";
import { libraryWords } from "./language/library-words.js";
import { textsOf } from "./language/markup.js";
import { PageError } from "./panel/page-error.js";

/**
 * A globe with nothing on it that another host would have to send: no ion, no geocoder, no terrain server.
 * @throws PageError PAGE_WEBGL where the browser gives no WebGL 2
 */
export function createViewer(container: HTMLElement): Viewer {
  const credits = document.createElement("div");
  credits.className = "credits";
  container.after(credits);
  let viewer: Viewer;
  try {
    viewer = new Viewer(container, {
      animation: false,
      baseLayer: false,
      baseLayerPicker: false,
      fullscreenButton: false,
      geocoder: false,
      homeButton: false,
      infoBox: false,
      navigationHelpButton: false,
      sceneModePicker: false,
      selectionIndicator: false,
      timeline: false,
      scene3DOnly: true,
      // Points are squares of whole pixels: several samples a pixel would cost time and change nothing.
      msaaSamples: 1,
      // A frame that would show what the one before does takes battery and fan for nothing.
      requestRenderMode: true,
      maximumRenderTimeChange: Number.POSITIVE_INFINITY,
      showRenderLoopErrors: false,
      creditContainer: credits,
    });
  } catch (thrown) {
    throw new PageError({
      code: "PAGE_WEBGL",
      file: i18n.t("the globe"),
      cause: i18n.t("this browser cannot draw it ({reason})", {
        reason: thrown instanceof Error ? thrown.message : String(thrown),
      }),
      fix: i18n.t("Use a browser with WebGL 2 and hardware acceleration switched on"),
    });
  }
  const { scene, canvas } = viewer;
  for (const root of [container, credits]) {
    for (const text of textsOf(root)) text.write(libraryWords(text.words));
  }
  // With this role screen readers leave the keys to the globe.
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", i18n.t("Globe with the point cloud, question mark for its keys"));
  // A double click goes to a point; by default it would bind the camera to the mark on it.
  viewer.screenSpaceEventHandler.removeInputAction(ScreenSpaceEventType.LEFT_DOUBLE_CLICK);
  scene.screenSpaceCameraController.minimumZoomDistance = 0.5;
  return viewer;
}

/**
 * Lays the Natural Earth map that comes with Cesium on the globe.
 * @throws PageError PAGE_BASE_MAP where the page's server does not have it
 */
export async function addBaseMap(viewer: Viewer): Promise<void> {
  const url = buildModuleUrl("Assets/Textures/NaturalEarthII");
  try {
    const provider = await TileMapServiceImageryProvider.fromUrl(url, { credit: "Natural Earth" });
    const layer = new ImageryLayer(provider, { brightness: 0.5, saturation: 0.5 });
    viewer.imageryLayers.add(layer);
  } catch {
    throw new PageError({
      code: "PAGE_BASE_MAP",
      file: url,
      cause: i18n.t("the base map cannot be loaded; the globe stays plain"),
      fix: i18n.t("Serve the folder cesium beside the page"),
    });
  }
}

/**
 * Gives the globe a terrain, which heights are measured above too.
 * @param address of the folder with its `layer.json`
 * @throws PageError PAGE_TERRAIN where there is none that Cesium reads
 */
export async function addTerrain(viewer: Viewer, address: string): Promise<void> {
  try {
    // Cesium takes a folder without one for a terrain of old, and the globe stays smooth without a word.
    const folder = new Resource({ url: address });
    folder.appendForwardSlash();
    await folder.getDerivedResource({ url: "layer.json" }).fetchJson();
    viewer.terrainProvider = await CesiumTerrainProvider.fromUrl(address);
  } catch {
    throw new PageError({
      code: "PAGE_TERRAIN",
      file: address,
      cause: i18n.t("there is no terrain that can be read; the globe stays smooth"),
      fix: i18n.t(
        "Give the folder with the terrain's layer.json (quantized-mesh or heightmap), from a server that lets this page read it",
      ),
    });
  }
}

/** Tells when the globe can no longer be drawn: PageError PAGE_DRAWING. */
export function watchDrawing({ scene, canvas }: Viewer, failed: (thrown: unknown) => void): void {
  const stopped = (cause: string) =>
    failed(
      new PageError({
        code: "PAGE_DRAWING",
        file: i18n.t("the globe"),
        cause: i18n.t("drawing stopped: {cause}", { cause }),
        fix: i18n.t("Reload the page; if it happens again, draw fewer points with ?budget=300000"),
      }),
    );
  scene.renderError.addEventListener((_scene: unknown, thrown: unknown) =>
    stopped(thrown instanceof Error ? thrown.message : String(thrown)),
  );
  canvas.addEventListener("webglcontextlost", () => stopped(i18n.t("the browser lost the graphics context")));
}

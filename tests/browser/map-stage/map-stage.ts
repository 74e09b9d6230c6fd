import { ecefToGeodetic } from "@groma/georef";
import {
  type PointCloud,
  PointCloudLayer,
  type PointCloudLayerOptions,
  PointCloudSource,
  type PointCloudSourceOptions,
} from "@groma/layer/openlayers";
import { OlMap, proj4, register, View } from "./ol.js";

/** A map's view in plain numbers. */
export interface StageView {
  readonly projection: string;
  readonly center: readonly number[];
  readonly resolution: number;
  readonly rotation?: number;
}

/** What a stage is set up with. */
export interface StageOptions {
  readonly view: StageView;
  readonly source: PointCloudSourceOptions;
  readonly layer?: Omit<PointCloudLayerOptions, "source">;
  /** Definitions of projections by their codes. */
  readonly projections?: Readonly<Record<string, string>>;
  readonly pixelRatio?: number;
}

/** A map of 600 × 400 pixels with one layer of points. */
export class MapStage {
  readonly map: OlMap;
  readonly source: PointCloudSource;
  readonly layer: PointCloudLayer;
  /** Codes of the errors that were raised. */
  readonly errors: string[] = [];
  readonly #pixelRatio: number;

  constructor({ view, source, layer, projections = {}, pixelRatio = 1 }: StageOptions) {
    for (const [code, definition] of Object.entries(projections)) proj4.defs(code, definition);
    register(proj4);
    this.#pixelRatio = pixelRatio;
    const target = document.createElement("div");
    Object.assign(target.style, { width: "600px", height: "400px" });
    document.body.append(target);
    this.source = new PointCloudSource(source);
    this.layer = new PointCloudLayer({ ...layer, source: this.source });
    for (const raiser of [this.source, this.layer]) {
      // biome-ignore lint/suspicious/noExplicitAny: OpenLayers types the event as its own
      raiser.addEventListener("error", (event: any) => {
        this.errors.push(event.error.code ?? String(event.error));
        return true;
      });
    }
    this.map = new OlMap({
      target,
      pixelRatio,
      controls: [],
      interactions: [],
      layers: [this.layer],
      view: viewOf(view),
    });
  }

  /** Shows another view; resolves when all that it wants is drawn. */
  async show(view: StageView): Promise<void> {
    this.map.setView(viewOf(view));
    await this.complete();
  }

  /** Resolves when all that the view wants is drawn. */
  complete(): Promise<void> {
    return new Promise((resolve) => {
      this.map.once("rendercomplete", () => resolve());
      this.map.render();
    });
  }

  /** Pixels of the layer's canvas that show something: x and y from the upper left. */
  lit(): [number, number][] {
    const { data, width } = this.pixels();
    const found: [number, number][] = [];
    for (let at = 3; at < data.length; at += 4) {
      if (data[at] > 0) found.push([((at - 3) / 4) % width, Math.floor((at - 3) / 4 / width)]);
    }
    return found;
  }

  /** The picture of the layer's canvas. */
  pixels(): ImageData {
    const canvas = this.map.getViewport().querySelector<HTMLCanvasElement>(".ol-layer canvas");
    if (!canvas) throw new Error("the layer is not on the map");
    const copy = new OffscreenCanvas(canvas.width, canvas.height);
    const context = copy.getContext("2d")!;
    context.drawImage(canvas, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height);
  }

  /** The map as an application copies it for a print: all canvases, one over the other. As OpenLayers' examples do. */
  copy(): ImageData {
    const [width, height] = this.map.getSize()!.map((edge) => edge * this.#pixelRatio) as [number, number];
    const context = new OffscreenCanvas(width, height).getContext("2d")!;
    const canvases = this.map.getViewport().querySelectorAll<HTMLCanvasElement>(".ol-layers canvas");
    for (const canvas of Array.from(canvases)) {
      if (canvas.width === 0) continue;
      const opacity = canvas.parentElement!.style.opacity || canvas.style.opacity;
      context.globalAlpha = opacity === "" ? 1 : Number(opacity);
      context.resetTransform();
      context.drawImage(canvas, 0, 0, width, height);
    }
    return context.getImageData(0, 0, width, height);
  }

  /** Height above the ellipsoid of source coordinates. */
  heightOf(cloud: PointCloud, [x, y, z]: readonly [number, number, number]): number {
    const [px, py, pz] = cloud.place(x, y, z);
    const geodetic = new Float64Array(3);
    ecefToGeodetic(px!, py!, pz!, geodetic);
    return geodetic[2]!;
  }

  destroy(): void {
    const target = this.map.getTargetElement();
    this.map.removeLayer(this.layer);
    this.map.dispose();
    this.layer.dispose();
    this.source.dispose();
    target?.remove();
  }
}

function viewOf({ projection, center, resolution, rotation = 0 }: StageView): View {
  return new View({
    projection,
    center: [...center],
    resolution,
    rotation,
    minResolution: 1e-9,
    maxResolution: 1e9,
    constrainRotation: false,
    multiWorld: true,
  });
}

import { ecefToGeodetic } from "@groma/georef";
import type { PointCloud, PointFilter, StyleParts } from "@groma/layer/openlayers";
import { PlotPicture, type PlotSeries } from "@groma/layer/plot";
import { PlotIndex, PlotView, Profile, type ProfileOptions, type ProfilePoints } from "@groma/layer/tools";
import { onPoints } from "../stage/point-calls.js";
import type { MapStage } from "./map-stage.js";

/** What was asked of a canvas' context since it was looked at last. */
interface Asked {
  /** Columns of nodes that were sent. */
  columns: number;
  textureBytes: number;
  pointsDrawn: number;
}

/** A plot of 600 × 300 pixels of a profile through the cloud of a map, drawn as the map's layer is. */
export class PlotStage {
  readonly view = new PlotView(600, 300);
  readonly parts: ProfilePoints[] = [];
  readonly series: PlotSeries;
  readonly options: ProfileOptions;
  readonly #picture: PlotPicture;
  readonly #canvas = document.createElement("canvas");
  readonly #map: MapStage;
  readonly #profile: Profile;
  readonly #index = new PlotIndex<ProfilePoints>();
  #asked: Asked = { columns: 0, textureBytes: 0, pointsDrawn: 0 };

  constructor(
    map: MapStage,
    cloud: PointCloud,
    options: ProfileOptions,
    shown: [number, number, number, number],
  ) {
    this.#map = map;
    this.options = options;
    this.#profile = new Profile(cloud, options);
    this.#picture = new PlotPicture(this.#canvas, () => undefined);
    this.series = this.#picture.addSeries(cloud, this.#drawing);
    const [from, to, low, high] = shown;
    this.view.fit({ from, to, low, high });
    this.#watch();
  }

  get #drawing() {
    const { style, filter } = this.#map.layer;
    return { style: style!, filter };
  }

  /** Reads all points of the profile, and draws each part of a node as if it came by itself. */
  async read(parts = 1): Promise<void> {
    for await (const points of this.#profile.points()) {
      const size = Math.ceil(points.chainage.length / parts);
      for (let from = 0; from < points.chainage.length; from += size) {
        const some = partOf(points, from, from + size);
        this.parts.push(some);
        this.series.add(some);
        await this.settle();
      }
    }
  }

  /**
   * Reads all points as a page does: what has come is drawn in the browser's next frame.
   * @returns milliseconds from the first points to the first picture of some, and to the last one
   */
  async readInFrames(): Promise<{ points: number; parts: number; first: number; last: number }> {
    let [began, first, reading] = [0, 0, true];
    const drawing = (async () => {
      for (let whole = false; reading || !whole; ) {
        await new Promise(requestAnimationFrame);
        whole = this.#picture.draw(this.view, 1);
        if (first === 0 && this.#asked.pointsDrawn > 0) first = performance.now() - began;
      }
    })();
    for await (const points of this.#profile.points()) {
      began ||= performance.now();
      this.parts.push(points);
      this.series.add(points);
      this.#index.add(points);
    }
    reading = false;
    await drawing;
    const { points } = this.series;
    return { points, parts: this.parts.length, first, last: performance.now() - began };
  }

  /** Draws until all is there. */
  async settle(): Promise<void> {
    while (!this.#picture.draw(this.view, 1)) await new Promise(requestAnimationFrame);
  }

  /** Has map and plot drawn by a style and a filter. */
  async restyle(style: StyleParts, filter: PointFilter | undefined): Promise<void> {
    Object.assign(this.#map.layer, { style, filter });
    await this.#map.complete();
    this.series.drawing = this.#drawing;
    await this.settle();
  }

  /** What was asked of the context since the last call. */
  asked(): Asked {
    const asked = this.#asked;
    this.#asked = { columns: 0, textureBytes: 0, pointsDrawn: 0 };
    return asked;
  }

  /** RGBA at a pixel. */
  colourAt(x: number, y: number): number[] {
    const copy = new OffscreenCanvas(this.#canvas.width, this.#canvas.height).getContext("2d")!;
    copy.drawImage(this.#canvas, 0, 0);
    return [...copy.getImageData(Math.round(x), Math.round(y), 1, 1).data];
  }

  /** The picture as a whole, for one to be held against another. */
  picture(): string {
    return this.#canvas.toDataURL();
  }

  destroy(): void {
    this.#picture.destroy();
  }

  /** Counts what goes through the context. */
  #watch(): void {
    const gl = this.#canvas.getContext("webgl2")!;
    const { bufferSubData, texImage2D } = gl;
    const counted = (count: (asked: Asked, values: unknown[]) => void, call: unknown) =>
      ((...values: unknown[]) => {
        count(this.#asked, values);
        return (call as (...values: unknown[]) => void).apply(gl, values);
      }) as never;
    gl.bufferSubData = counted((asked) => asked.columns++, bufferSubData);
    gl.texImage2D = counted((asked, values) => {
      asked.textureBytes += (values.at(-1) as Uint8Array).byteLength;
    }, texImage2D);
    onPoints(gl, (call) => {
      this.#asked.pointsDrawn += call.counts.reduce((sum, count) => sum + count, 0);
      call.draw();
    });
  }
}

/** Some of the points of a node. */
function partOf({ batch, chainage, offset, height }: ProfilePoints, from: number, to: number): ProfilePoints {
  const [along, aside, up] = [chainage, offset, height].map((numbers) => numbers.subarray(from, to));
  const inside = batch.inside.subarray(from, to);
  return { batch: { ...batch, inside }, chainage: along!, offset: aside!, height: up! };
}

/** A line from west to east through the middle of a cloud: longitudes and latitudes, radians. */
export function lineThrough(cloud: PointCloud): [number, number][] {
  const { min, max } = cloud.boundingBox;
  return [0.02, 0.98].map((share) => {
    const [x, y, z] = cloud.place(min[0] + share * (max[0] - min[0]), (min[1] + max[1]) / 2, min[2]);
    const geodetic = new Float64Array(3);
    ecefToGeodetic(x!, y!, z!, geodetic);
    return [geodetic[0]!, geodetic[1]!];
  });
}

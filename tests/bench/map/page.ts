import { PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import { MapStage } from "../../browser/map-stage/map-stage.js";
import { onPoints } from "../../browser/stage/point-calls.js";
import { Stage } from "../../browser/stage/stage.js";

/** CSS pixels, of both. */
const SIZE = { width: 600, height: 400 };

/** Rounds before those that count: code is compiled in them. */
const WARM = 10;

/** What is drawn, by both. */
export interface Asked {
  readonly points: number;
  readonly style: Readonly<Record<string, unknown>>;
  /** Frames of each that count. */
  readonly frames: number;
}

/** Milliseconds of script in a frame whose view has moved: medians. */
interface Script {
  readonly points: number;
  readonly nodes: number;
  readonly whole: number;
  /** The same with the layer hidden. */
  readonly empty: number;
  /** Calls that draw, in a frame. */
  readonly draws: number;
}

/** What a frame takes of the page's thread on the globe and on the map. */
export interface Figures {
  readonly globe: Script;
  readonly map: Script;
  /** Calls that draw or clear in frames of a map that stands still. */
  readonly still: number;
}

/** One side of the comparison. */
interface Side {
  /** Moves the view and draws a frame. */
  frame(step: number): void;
  show(shown: boolean): void;
  readonly shown: { readonly points: number; readonly nodes: number };
}

let draws = 0;
const { clear } = WebGL2RenderingContext.prototype;
// Points are not rasterised: in software that is done by the same cores, and is no script.
onPoints(WebGL2RenderingContext.prototype, (call) => {
  draws++;
  call.draw("none");
});
WebGL2RenderingContext.prototype.clear = function (mask) {
  draws++;
  clear.call(this, mask);
};

/** A globe and a map that show one scan from above. */
class MapBesideGlobe {
  #cloud: PointCloud | undefined;

  async measure(address: string, { points, style, frames }: Asked): Promise<Figures> {
    this.#cloud ??= await PointCloud.fromUrl(address, { limits: { cacheBytes: 2 ** 31 } });
    const drawing = {
      pointBudget: points,
      maximumScreenSpaceError: 0.25,
      style: { size: "fixed", shape: "square", pointSize: 2, eyeDomeLighting: false, ...style },
    } as const;
    const globe = await globeOf(this.#cloud, drawing);
    const map = await mapOf(this.#cloud, drawing);
    const sides = { globe: globe.side, map: map.side };
    const times = { globe: { whole: [], empty: [] }, map: { whole: [], empty: [] } } as Times;
    const counts = { globe: 0, map: 0 };
    for (let round = 0; round < WARM + frames; round++) {
      for (const [name, side] of Object.entries(sides) as [keyof Times, Side][]) {
        side.show(false);
        side.frame(2 * round);
        const empty = timed(() => side.frame(2 * round + 1));
        side.show(true);
        side.frame(2 * round);
        draws = 0;
        const whole = timed(() => side.frame(2 * round + 1));
        counts[name] = draws;
        if (round < WARM) continue;
        times[name].whole.push(whole);
        times[name].empty.push(empty);
      }
      await new Promise((done) => setTimeout(done));
    }
    const figures = (name: keyof Times): Script => ({
      ...sides[name].shown,
      ...{ whole: median(times[name].whole), empty: median(times[name].empty), draws: counts[name] },
    });
    await map.stage.complete();
    draws = 0;
    for (let frame = 0; frame < 10; frame++) map.stage.map.renderSync();
    const still = draws;
    const result = { globe: figures("globe"), map: figures("map"), still };
    if (map.stage.errors.length > 0) throw new Error(`the map failed: ${map.stage.errors}`);
    map.stage.destroy();
    globe.stage.destroy();
    return result;
  }
}

type Times = Record<"globe" | "map", { readonly whole: number[]; readonly empty: number[] }>;
type Drawing = ConstructorParameters<typeof MapStage>[0]["layer"] & object;

async function globeOf(cloud: PointCloud, drawing: Drawing) {
  const stage = new Stage(SIZE);
  const layer = PointCloudLayer.fromCloud(cloud, drawing as Parameters<typeof PointCloudLayer.fromCloud>[1]);
  stage.layer = layer;
  stage.scene.primitives.add(layer);
  const { camera } = stage.scene;
  camera.viewBoundingSphere(layer.boundingSphere);
  await stage.settle([layer], 600_000);
  const side: Side = {
    frame(step) {
      camera.moveRight(step % 2 === 0 ? 1 : -1);
      stage.frame();
    },
    show: (shown) => {
      layer.show = shown;
    },
    get shown() {
      const { pointsDrawn, nodesLoaded } = layer.statistics;
      return { points: pointsDrawn, nodes: nodesLoaded };
    },
  };
  return { stage, side };
}

async function mapOf(cloud: PointCloud, drawing: Drawing) {
  const view = { projection: "EPSG:3857", center: [0, 0], resolution: 1 };
  const stage = new MapStage({ view, source: { cloud }, layer: drawing });
  await stage.source.opened();
  const [minX, minY, maxX, maxY] = stage.source.getExtent("EPSG:3857")!;
  const [x, y] = [(minX! + maxX!) / 2, (minY! + maxY!) / 2];
  const resolution = Math.max((maxX! - minX!) / SIZE.width, (maxY! - minY!) / SIZE.height);
  await stage.show({ ...view, center: [x, y], resolution });
  const side: Side = {
    frame(step) {
      stage.map.getView().setCenter([x + (step % 2), y]);
      stage.map.renderSync();
    },
    show: (shown) => stage.layer.setVisible(shown),
    get shown() {
      const { pointsDrawn, nodesLoaded } = stage.layer.statistics;
      return { points: pointsDrawn, nodes: nodesLoaded };
    },
  };
  return { stage, side };
}

function timed(work: () => void): number {
  const began = performance.now();
  work();
  return performance.now() - began;
}

function median(times: readonly number[]): number {
  return [...times].sort((a, b) => a - b)[Math.floor(times.length / 2)]!;
}

Object.assign(window, { MapBesideGlobe });
document.body.dataset.ready = "true";

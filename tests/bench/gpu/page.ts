import { PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import { Matrix4 } from "cesium";
import { LayerContent } from "../../../layer/dist/drawing/layer-content.js";
import { Stage } from "../../browser/stage/stage.js";
import { settle } from "../settle.js";
import { PlainGl, type PlainPoints } from "./plain-points.js";

/** What the layer draws of a node. */
interface Node {
  readonly count: number;
  readonly uploaded: {
    readonly vertices: {
      readonly frame: { readonly rotation: ArrayLike<number>; readonly origin: ArrayLike<number> };
      readonly positions: Float32Array;
      readonly columns: ReadonlyMap<string, { readonly data?: ArrayLike<number> }>;
    };
  };
}

/** What is drawn. */
export interface Asked {
  readonly points: number;
  readonly style: Readonly<Record<string, unknown>>;
  readonly logDepth: boolean;
  readonly frames: number;
}

/**
 * Milliseconds of a frame: in software of the processor, the mean of all frames; on a card by the clock, the least of them,
 * since other work on the machine only adds.
 */
export interface Figures {
  readonly points: number;
  readonly nodes: number;
  /** From the call to the picture, of a view that moves. */
  readonly frame: number;
  /** The same of a view that stands still. */
  readonly still: number;
  /** Of it, what runs on the main thread, by the clock, the least. */
  readonly script: number;
  /** The same without the layer. */
  readonly empty: number;
  readonly emptyScript: number;
  /** The same points by plain WebGL. */
  readonly plain: number;
}

/** Milliseconds. */
const LONGEST_LOADING = 600_000;

/** Width of points in all that is compared, pixels. */
const PIXELS = 2;

/** A scene of one scan, and the points that it shows drawn without any library. */
class Gpu {
  readonly #size: { readonly width: number; readonly height: number };
  readonly #address: string;
  readonly #times: Times;
  #cloud: PointCloud | undefined;

  /** @param card whether a graphics card draws, and not the processor */
  constructor(address: string, size: { readonly width: number; readonly height: number }, card: boolean) {
    this.#address = address;
    this.#size = size;
    this.#times = card ? BY_CLOCK : BY_PROCESSOR;
  }

  async measure({ points, style, logDepth, frames }: Asked): Promise<Figures> {
    this.#cloud ??= await PointCloud.fromUrl(this.#address, { limits: { cacheBytes: 2 ** 31 } });
    const stage = new Stage({ ...this.#size, logDepth });
    const shown = watchContent();
    const layer = PointCloudLayer.fromCloud(this.#cloud, {
      pointBudget: points,
      maximumScreenSpaceError: 0.25,
      style: { size: "fixed", shape: "square", pointSize: PIXELS, eyeDomeLighting: false, ...style },
    });
    stage.layer = layer;
    stage.scene.primitives.add(layer);
    stage.scene.camera.viewBoundingSphere(layer.boundingSphere);
    await settle(stage, LONGEST_LOADING);
    const nodes = shown();
    const plain = new PlainGl(
      this.#size,
      plainPoints(nodes, stage.scene.camera.viewMatrix, this.#size),
      PIXELS,
    );
    const draw = { frame: () => stage.frame(), wait: () => stage.wait() };
    const moved = {
      ...draw,
      frame() {
        stage.sway();
        stage.frame();
      },
    };
    const times = {
      frame: [] as number[],
      script: [] as number[],
      still: [] as number[],
      plain: [] as number[],
    };
    const empty = { frame: [] as number[], script: [] as number[] };
    for (let round = 0; round < frames + 2; round++) {
      const still = await timed(this.#times, draw);
      const ours = await timed(this.#times, moved);
      const theirs = await timed(this.#times, plain);
      layer.show = false;
      stage.frame();
      const nothing = await timed(this.#times, draw);
      layer.show = true;
      await settle(stage, LONGEST_LOADING);
      stage.frame();
      // The first ones compile and warm up.
      if (round < 2) continue;
      times.frame.push(ours.whole);
      times.script.push(ours.script);
      times.still.push(still.whole);
      times.plain.push(theirs.whole);
      empty.frame.push(nothing.whole);
      empty.script.push(nothing.script);
    }
    const errors = stage.errors();
    if (errors.length > 0) throw new Error(`WebGL errors ${errors}`);
    plain.destroy();
    stage.destroy();
    const { figureOf } = this.#times;
    return {
      points: nodes.reduce((sum, { count }) => sum + count, 0),
      nodes: nodes.length,
      ...{ frame: figureOf(times.frame), script: least(times.script), still: figureOf(times.still) },
      plain: figureOf(times.plain),
      ...{ empty: figureOf(empty.frame), emptyScript: least(empty.script) },
    };
  }

  /** What draws, as it says itself. */
  get renderer(): string {
    const gl = document.createElement("canvas").getContext("webgl2");
    const info = gl?.getExtension("WEBGL_debug_renderer_info");
    return String(gl && info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "unknown");
  }
}

/** @returns gives the nodes that the last frame of any layer drew */
function watchContent(): () => readonly Node[] {
  let content: { readonly nodes: readonly Node[] } | undefined;
  const { prepare } = LayerContent.prototype;
  LayerContent.prototype.prepare = function (...given) {
    content = this as unknown as { readonly nodes: readonly Node[] };
    return prepare.apply(this, given);
  };
  return () => {
    LayerContent.prototype.prepare = prepare;
    return content?.nodes ?? [];
  };
}

/** The points that are drawn, as the camera sees them. */
function plainPoints(
  nodes: readonly Node[],
  view: Matrix4,
  size: { width: number; height: number },
): PlainPoints {
  const count = nodes.reduce((sum, node) => sum + node.count, 0);
  const positions = new Float32Array(3 * count);
  const colours = new Uint8Array(3 * count).fill(128);
  let [at, near, far] = [0, Number.POSITIVE_INFINITY, 0];
  for (const { count, uploaded } of nodes) {
    const m = Matrix4.multiplyTransformation(view, placeOf(uploaded), new Matrix4()) as ArrayLike<number>;
    const { positions: own, columns } = uploaded.vertices;
    const rgb = columns.get("rgb")?.data;
    for (let index = 0; index < count; index++, at += 3) {
      const [x, y, z] = [own[3 * index]!, own[3 * index + 1]!, own[3 * index + 2]!];
      for (let row = 0; row < 3; row++) {
        positions[at + row] = m[row]! * x + m[row + 4]! * y + m[row + 8]! * z + m[row + 12]!;
        if (rgb && rgb.length >= 3 * (index + 1)) colours[at + row] = rgb[3 * index + row]!;
      }
      near = Math.min(near, -positions[at + 2]!);
      far = Math.max(far, -positions[at + 2]!);
    }
  }
  near = Math.max(near / 2, 0.1);
  far *= 2;
  // Cesium's field of view is that of the longer side.
  const x = 1 / Math.tan(Math.PI / 6);
  const y = (x * size.width) / size.height;
  const projection = [
    ...[x, 0, 0, 0, 0, y, 0, 0],
    ...[0, 0, -(far + near) / (far - near), -1],
    ...[0, 0, (-2 * far * near) / (far - near), 0],
  ];
  return { positions, colours, projection };
}

/** Node frame → ECEF. */
function placeOf({ vertices: { frame } }: Node["uploaded"]): Matrix4 {
  const [ex, ey, ez, nx, ny, nz, ux, uy, uz] = Array.from(frame.rotation) as Nine;
  const [x, y, z] = Array.from(frame.origin) as [number, number, number];
  return new Matrix4(ex, nx, ux, x, ey, ny, uy, y, ez, nz, uz, z, 0, 0, 0, 1);
}

type Nine = [number, number, number, number, number, number, number, number, number];

const least = (times: readonly number[]) => Math.min(...times);

/** How frames are timed, and what counts of many. */
interface Times {
  now(): Promise<number>;
  figureOf(times: readonly number[]): number;
}

const BY_CLOCK: Times = { now: async () => performance.now(), figureOf: least };
const BY_PROCESSOR: Times = {
  now: () => window.processorTime(),
  figureOf: (times) => times.reduce((sum, time) => sum + time, 0) / times.length,
};

async function timed(
  { now }: Times,
  drawn: { frame(): void; wait(): void },
): Promise<{ readonly whole: number; readonly script: number }> {
  drawn.wait();
  const began = await now();
  const start = performance.now();
  drawn.frame();
  const script = performance.now() - start;
  drawn.wait();
  return { whole: (await now()) - began, script };
}

Object.assign(window, { Gpu });
document.body.dataset.ready = "";

declare global {
  interface Window {
    Gpu: typeof Gpu;
  }
}

import { BoundingRectangle, type Camera, Matrix4 } from "cesium";
import { silhouettesOf } from "../drawing/silhouettes.js";
import { type DrawnNode, pointOf } from "./drawn-node.js";
import { type Framebuffer, type FrameState, PassState, type Texture } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { readPixels } from "./engine/pixel-readback.js";
import { matrixOf } from "./node-drawable.js";
import type { OffscreenPass, PassSetting } from "./offscreen-pass.js";
import { candidatesAt } from "./pick-candidates.js";
import type { PointFrustum } from "./point-frustum.js";

/** Windows on the picture, in rows and columns, and their size in pixels: together 13,824. */
const WINDOWS = 3;
const WINDOW = { width: 48, height: 32 };

/** Milliseconds between two measurements while the view changes; once it rests it is measured at once. */
const INTERVAL = 500;

/** A frame that silhouettes are looked for in. */
export interface ProbedFrame {
  readonly frameState: FrameState;
  /** Nodes as they are drawn, by rising `firstId`. */
  readonly nodes: readonly DrawnNode[];
  readonly heightOffset: number;
  /** Width of the widest points, CSS pixels. */
  readonly widest: number;
  readonly setting: Omit<PassSetting, "target">;
  /** What else decides which points show, and how: compared one by one. */
  readonly by: readonly unknown[];
}

/**
 * Measures how much of the picture steps in depth: in windows spread over it, the numbers of the points are drawn as
 * they are for a pick, at the picture's own size, and read back when the GPU has them. The depths are those of the
 * points, in float64. A view is measured once it rests, and one that changes now and then.
 */
export class SilhouetteProbe {
  readonly #objects: GpuObjects;
  readonly #pass: OffscreenPass;
  #target:
    | { readonly colour: Texture; readonly depth: Texture; readonly framebuffer: Framebuffer }
    | undefined;
  #share: number | undefined;
  /** What the last frame showed, and what was measured last. */
  #seen: ProbedView = NOTHING;
  #measured: ProbedView = NOTHING;
  #began = Number.NEGATIVE_INFINITY;
  #underWay: object | undefined;

  constructor(objects: GpuObjects, pass: OffscreenPass) {
    this.#objects = objects;
    this.#pass = pass;
  }

  /** Share of the pixels that show points whose depth steps by 1 % or more; undefined until it was measured. */
  get share(): number | undefined {
    return this.#share;
  }

  /**
   * Looks at a frame, within Cesium's update.
   * @returns whether the view is still to be measured, or its answer is on its way
   */
  follow(frame: ProbedFrame): boolean {
    const view = viewOf(frame);
    const resting = isSame(view, this.#seen);
    this.#seen = view;
    if (isSame(view, this.#measured) || this.#underWay) return this.#underWay !== undefined;
    const now = performance.now();
    if (!resting && now - this.#began < INTERVAL) return true;
    this.#began = now;
    this.#measured = view;
    void this.#measure(frame);
    return true;
  }

  /** Nothing is to be measured any more: frees what it took. */
  rest(): void {
    this.#underWay = undefined;
    this.#share = undefined;
    this.#seen = NOTHING;
    this.#measured = NOTHING;
    for (const object of [this.#target?.framebuffer, this.#target?.colour, this.#target?.depth]) {
      this.#objects.free(object);
    }
    this.#target = undefined;
  }

  async #measure(frame: ProbedFrame): Promise<void> {
    const run = {};
    this.#underWay = run;
    const { nodes, setting, frameState } = frame;
    const reliefs = nodes.map((node) => reliefOf(node, frame));
    const gone = () => this.#underWay !== run;
    const drawn = this.#draw(frame, gone);
    setting.context.uniformState.updateFrustum(frameState.camera.frustum as PointFrustum["frustum"]);
    const pictures = await Promise.all(drawn);
    if (gone()) return;
    this.#underWay = undefined;
    let covered = 0;
    let steps = 0;
    for (const pixels of pictures) {
      if (!pixels) return;
      const found = silhouettesOf(depthsOf(pixels, nodes, reliefs), WINDOW.width);
      covered += found.covered;
      steps += found.steps;
    }
    this.#share = covered > 0 ? steps / covered : undefined;
  }

  /** Draws the windows, one after the other into one small picture, each of which is read before the next is drawn. */
  #draw({ frameState, nodes, widest, setting }: ProbedFrame, gone: () => boolean) {
    const { context, camera, pixelRatio } = frameState;
    const { width, height } = WINDOW;
    const target = new PassState(context);
    this.#target ??= this.#makeTarget();
    const { framebuffer } = this.#target;
    target.framebuffer = framebuffer;
    const reach = Math.hypot(width, height) / 2 / pixelRatio + widest;
    return middles(context.drawingBufferWidth, context.drawingBufferHeight).map(({ x, y }) => {
      const { drawingBufferWidth, drawingBufferHeight } = context;
      target.viewport = new BoundingRectangle(
        ...[Math.round(width / 2 - x), Math.round(height / 2 - y)],
        ...[drawingBufferWidth, drawingBufferHeight],
      );
      const position = { x: x / pixelRatio, y: (drawingBufferHeight - y) / pixelRatio };
      this.#pass.clear(context, target, true);
      this.#pass.draw("id", candidatesAt(camera, position, reach, nodes), { ...setting, target });
      return readPixels(this.#objects, framebuffer, { size: WINDOW, gone });
    });
  }

  #makeTarget() {
    const { width, height } = WINDOW;
    const colour = this.#objects.colourTexture(width, height, "byte");
    const depth = this.#objects.depthTexture(width, height);
    return { colour, depth, framebuffer: this.#objects.framebuffer([colour], depth) };
  }
}

/** Middles of the windows, pixels. */
function middles(width: number, height: number): { readonly x: number; readonly y: number }[] {
  return Array.from({ length: WINDOWS ** 2 }, (_, index) => ({
    x: (((index % WINDOWS) + 0.5) / WINDOWS) * width,
    y: ((Math.floor(index / WINDOWS) + 0.5) / WINDOWS) * height,
  }));
}

/** What a measurement depends on. */
type ProbedView = readonly unknown[];

const NOTHING: ProbedView = [];

function viewOf({ frameState: { camera, context }, nodes, heightOffset, by }: ProbedFrame): ProbedView {
  const { viewMatrix, frustum } = camera as Camera & { frustum: PointFrustum["frustum"] };
  const points = nodes.reduce((sum, { count }) => sum + count, 0);
  const { drawingBufferWidth, drawingBufferHeight } = context;
  const numbers = [drawingBufferWidth, drawingBufferHeight, nodes.length, points, heightOffset];
  return [`${viewMatrix}`, `${frustum.projectionMatrix}`, ...numbers, ...by];
}

function isSame(a: ProbedView, b: ProbedView): boolean {
  return a.length === b.length && a.every((value, index) => value === b[index]);
}

/** Gives what Eye-Dome Lighting compares of a point (see `composePass`): log2 of its eye depth, or what stands for it. */
type Relief = (index: number) => number;

function reliefOf({ drawable: { vertices } }: DrawnNode, frame: ProbedFrame): Relief {
  const { frameState, heightOffset, setting } = frame;
  const { orthographic, frustum } = setting.frustum;
  const toEye = Matrix4.multiplyTransformation(
    frameState.camera.viewMatrix,
    matrixOf(vertices, heightOffset),
    new Matrix4(),
  );
  const [, , x, , , , y, , , , z, , , , w] = Matrix4.toArray(toEye);
  const { positions } = vertices;
  const perMetre = frustum.projectionMatrix[5] / (Math.sqrt(3) * Math.LN2);
  return (index) => {
    const at = 3 * index;
    const depth = -(x * positions[at] + y * positions[at + 1] + z * positions[at + 2] + w);
    return orthographic ? depth * perMetre : Math.log2(depth);
  };
}

/** Relief of each pixel by the number of its point; NaN where there is none. */
function depthsOf(pixels: Uint8Array, nodes: readonly DrawnNode[], reliefs: readonly Relief[]): Float64Array {
  const numbers = new DataView(pixels.buffer, pixels.byteOffset, pixels.byteLength);
  const places = new Map(nodes.map((node, index) => [node, index] as const));
  return Float64Array.from({ length: pixels.length / 4 }, (_, pixel) => {
    const id = numbers.getUint32(4 * pixel, true);
    const found = id > 0 ? pointOf(nodes, id - 1) : undefined;
    return found ? reliefs[places.get(found.drawn)!](found.index) : Number.NaN;
  });
}

import { type DrawnNode, pointOf, type ViewTypes } from "./drawn-node.js";
import type { Size } from "./pick-window.js";
import { silhouettesOf } from "./silhouettes.js";

/** Windows on the picture, in rows and columns, and their size in pixels: together 13,824. */
const WINDOWS = 3;
const WINDOW: Size = { width: 48, height: 32 };

/** Milliseconds between two measurements while the view changes; once it rests it is measured at once. */
const INTERVAL = 500;

/** Gives what Eye-Dome Lighting compares of a point (see `eye-dome-lighting.ts`): log2 of its eye depth, or what stands for it. */
export type Relief = (index: number) => number;

/** A frame that silhouettes are looked for in. */
export interface ProbedFrame<V extends ViewTypes> {
  /** Nodes as they are drawn, by rising `firstId`. */
  readonly nodes: readonly DrawnNode<V>[];
  /** Size of the picture. */
  readonly size: Size;
  /** What decides which points show, where and how: compared one by one, numbers but for their rounding. */
  readonly by: readonly unknown[];
  /** Relief of a node's points in this frame. */
  reliefOf(node: DrawnNode<V>): Relief;
  /**
   * Draws the numbers of the points that show in windows of the picture, and reads them back when the GPU has them.
   * @param middles of the windows, pixels from the lower left
   * @param gone whether nobody waits for them any more
   * @returns of each window RGBA bytes, a number per pixel with its least significant byte first; undefined where it is
   *   gone, or its context is lost
   */
  numbersIn(
    middles: readonly Middle[],
    window: Size,
    gone: () => boolean,
  ): Promise<(Uint8Array | undefined)[]>;
}

/** Middle of a window, pixels from the lower left. */
export interface Middle {
  readonly x: number;
  readonly y: number;
}

/**
 * Share of a number by which it may differ and be the same: a scene may move its camera by its own rounding in every frame
 * (as Cesium does), which nobody sees: 6 mm at most on the globe.
 */
const ROUNDING = 1e-9;

const NOTHING: readonly unknown[] = [];

/**
 * Measures how much of the picture steps in depth: in windows spread over it, the numbers of the points are drawn as
 * they are for a pick, at the picture's own size, and read back when the GPU has them. The depths are those of the
 * points, in float64. A view is measured once it rests, and one that changes now and then.
 */
export class SilhouetteProbe<V extends ViewTypes> {
  #share: number | undefined;
  /** What the last frame showed, and what was measured last. */
  #seen = NOTHING;
  #measured = NOTHING;
  #began = Number.NEGATIVE_INFINITY;
  #underWay: object | undefined;

  /** Share of the pixels that show points whose depth steps by 1 % or more; undefined until it was measured. */
  get share(): number | undefined {
    return this.#share;
  }

  /**
   * Looks at a frame that was just drawn.
   * @returns whether the view is still to be measured, or its answer is on its way
   */
  follow(frame: ProbedFrame<V>): boolean {
    const { nodes, size, by } = frame;
    const points = nodes.reduce((sum, { count }) => sum + count, 0);
    const view = [size.width, size.height, nodes.length, points, ...by];
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

  /** Nothing is to be measured any more. */
  rest(): void {
    this.#underWay = undefined;
    this.#share = undefined;
    this.#seen = NOTHING;
    this.#measured = NOTHING;
  }

  async #measure(frame: ProbedFrame<V>): Promise<void> {
    const run = {};
    this.#underWay = run;
    const { nodes, size } = frame;
    const reliefs = new Map(nodes.map((node) => [node, frame.reliefOf(node)] as const));
    const gone = () => this.#underWay !== run;
    let pictures: (Uint8Array | undefined)[] = [];
    try {
      pictures = await frame.numbersIn(middlesOf(size), WINDOW, gone);
      if (gone()) return;
    } finally {
      // Nobody waits for a measurement that failed.
      if (!gone()) this.#underWay = undefined;
    }
    let covered = 0;
    let steps = 0;
    for (const pixels of pictures) {
      if (!pixels) return;
      const found = silhouettesOf(reliefOfPixels(pixels, nodes, reliefs), WINDOW.width);
      covered += found.covered;
      steps += found.steps;
    }
    this.#share = covered > 0 ? steps / covered : undefined;
  }
}

function middlesOf({ width, height }: Size): Middle[] {
  return Array.from({ length: WINDOWS ** 2 }, (_, index) => ({
    x: (((index % WINDOWS) + 0.5) / WINDOWS) * width,
    y: ((Math.floor(index / WINDOWS) + 0.5) / WINDOWS) * height,
  }));
}

function isSame(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a.length === b.length && a.every((value, index) => isAlike(value, b[index]));
}

function isAlike(a: unknown, b: unknown): boolean {
  if (typeof a !== "number" || typeof b !== "number") return a === b;
  return Math.abs(a - b) <= ROUNDING * Math.max(1, Math.abs(a));
}

/** Relief of each pixel by the number of its point; NaN where there is none. */
function reliefOfPixels<Node extends DrawnNode>(
  pixels: Uint8Array,
  nodes: readonly Node[],
  reliefs: ReadonlyMap<Node, Relief>,
): Float64Array {
  const numbers = new DataView(pixels.buffer, pixels.byteOffset, pixels.byteLength);
  return Float64Array.from({ length: pixels.length / 4 }, (_, pixel) => {
    const id = numbers.getUint32(4 * pixel, true);
    const found = id > 0 ? pointOf(nodes, id - 1) : undefined;
    return found ? reliefs.get(found.drawn)!(found.index) : Number.NaN;
  });
}

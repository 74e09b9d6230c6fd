import { ClipSet, PointCloud, PointCloudLayer } from "@groma/layer/cesium";
import type { LayerOptions, Pose } from "../../../browser/stage/setting.js";
import { Stage } from "../../../browser/stage/stage.js";
import { settle } from "../../settle.js";
import { type Coverage, countingFragments, fragmentsIn, holesIn, outlineOf, WHITE } from "./coverage.js";
import { type Difference, differenceOf, type Picture, pictureOf, strip } from "./picture.js";

/** How a scan is drawn. */
export interface Look extends LayerOptions {
  /** Nodes are drawn whole or not at all, against the layer's own way. Default: false. */
  readonly wholeNodes?: boolean;
  /** Nothing is drawn but the scene itself. Default: false. */
  readonly empty?: boolean;
  /** Whether the scene's depth is logarithmic. Default: true. */
  readonly logDepth?: boolean;
}

/** What a look draws. */
export interface Shown {
  readonly points: number;
  readonly nodes: number;
  /** Of vertices, a point. */
  readonly bytes: number;
  /** Effects that the layer's ledger calls active. */
  readonly effects: readonly string[];
}

/** One for a look without what is measured, one for a look with it. */
export interface Pair<Value> {
  readonly off: Value;
  readonly on: Value;
}

/** What two looks cost, and how far their pictures are apart and from what could be seen. */
export interface Comparison {
  /** Milliseconds of the processor for frames; those of the same index followed each other. */
  readonly times: Pair<readonly number[]>;
  readonly shown: Pair<Shown>;
  readonly change: Difference;
  /** Against references. */
  readonly error: Pair<Difference>;
}

/** Pixels. */
export const WIDTH = 640;
export const HEIGHT = 400;

/** Samples per pixel's edge of a reference. */
const SAMPLES = 2;

/** Width of the points of a reference, pixels: the least that leaves no holes where the scan has none. */
const NARROW = 1.5;

/** Spacing on the screen that no node falls short of, pixels. */
const ALL = 1e-6;

const SIDES = ["off", "on"] as const;

/** Frames that are drawn before any is timed: programs are compiled at first use, caches are cold. */
const WARM_UP = 2;

/** Milliseconds. */
const LONGEST_LOADING = 900_000;

/** Two views of one scan that take turns, and a third, finer one that sees every point: all from the same place. */
export class Bench {
  readonly #cloudOf: (tolerance: number | undefined) => Promise<PointCloud>;
  readonly #pose: Pose;
  readonly #stages: Pair<Stage>;
  readonly #fine: Stage;
  readonly #whole = new WeakSet<object>();
  /** Streams that are watched. */
  readonly #seen = new WeakSet<object>();
  readonly #shown: Record<keyof Pair<unknown>, { readonly key: string; readonly shown: Shown } | undefined> =
    {
      off: undefined,
      on: undefined,
    };
  readonly #references = new Map<string, Picture>();

  private constructor(cloudOf: (tolerance: number | undefined) => Promise<PointCloud>, pose: Pose) {
    this.#cloudOf = async (tolerance) => this.#watched(await cloudOf(tolerance));
    this.#pose = pose;
    const size = { width: WIDTH, height: HEIGHT };
    this.#stages = { off: new Stage(size), on: new Stage(size) };
    this.#fine = new Stage({ ...size, pixelRatio: SAMPLES });
  }

  /** @param cacheBytes bytes of vertices that are kept, enough for all that the pose sees */
  static async open(url: string, pose: Pose, cacheBytes: number): Promise<Bench> {
    const clouds = new Map<number | undefined, Promise<PointCloud>>();
    const cloudOf = (tolerance: number | undefined) => {
      const cloud = clouds.get(tolerance) ?? PointCloud.fromUrl(url, { limits: { cacheBytes }, tolerance });
      clouds.set(tolerance, cloud);
      return cloud;
    };
    await cloudOf(undefined);
    return new Bench(cloudOf, pose);
  }

  /** Name of what draws, as WebGL has it. */
  get renderer(): string {
    const { gl } = this.#fine;
    const info = gl.getExtension("WEBGL_debug_renderer_info");
    return String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  }

  /**
   * Draws two looks in turn.
   * @param truths what they are held against: looks that are drawn with every point of the file that the pose sees
   * @param pairs frames of each that are timed
   */
  async compare(looks: Pair<Look>, truths: Pair<Look>, pairs: number): Promise<Comparison> {
    const shown = { off: await this.#show("off", looks.off), on: await this.#show("on", looks.on) };
    const references = { off: await this.#reference(truths.off), on: await this.#reference(truths.on) };
    const times = await this.#time(pairs);
    const pictures = { off: this.#picture("off"), on: this.#picture("on") };
    return {
      times,
      shown,
      change: differenceOf(pictures.off, pictures.on),
      error: {
        off: differenceOf(pictures.off, references.off),
        on: differenceOf(pictures.on, references.on),
      },
    };
  }

  /** How well a look covers what a reference with every point shows, and how far it is from it. */
  async coverage(look: Look): Promise<Shown & Coverage & Difference> {
    const shown = await this.#show("on", look);
    const difference = differenceOf(this.#picture("on"), await this.#reference({}));
    const outline = outlineOf(await this.#reference({ style: WHITE }));
    const stage = this.#stages.on;
    this.#shown.on = undefined;
    stage.layer.style = WHITE;
    await settle(stage, LONGEST_LOADING);
    const holes = holesIn(this.#picture("on"), outline);
    const overdraw = fragmentsIn(
      countingFragments(stage, () => this.#picture("on")),
      outline,
    );
    return { ...shown, ...difference, holes, overdraw };
  }

  /** Points that a reference is drawn with. */
  async everyPoint(truth: Look): Promise<number> {
    await this.#reference(truth);
    return this.#fine.layer.statistics.pointsDrawn;
  }

  /** The middles of the two looks compared last, then of a reference, as a JPEG in base64. */
  async strip(truth: Look, width: number, height: number, bytes: number): Promise<string> {
    const pictures = [this.#picture("off"), this.#picture("on"), await this.#reference(truth)];
    return strip(pictures, width, height, bytes);
  }

  /** A cloud whose nodes are drawn whole for layers that ask for it. */
  #watched(cloud: PointCloud): PointCloud {
    const { stream } = cloud;
    if (this.#seen.has(stream)) return cloud;
    this.#seen.add(stream);
    const update = stream.update.bind(stream);
    stream.update = (viewer, view, options) =>
      update(viewer, view, this.#whole.has(viewer) ? { ...options, prefix: false } : options);
    return cloud;
  }

  /** Shows a look, unless that is what is shown already. */
  async #show(side: keyof Pair<unknown>, look: Look): Promise<Shown> {
    const key = JSON.stringify(look);
    const known = this.#shown[side];
    if (known?.key === key) return known.shown;
    const shown = await this.#draw(this.#stages[side], look);
    this.#shown[side] = { key, shown };
    return shown;
  }

  async #draw(stage: Stage, look: Look): Promise<Shown> {
    const { wholeNodes, empty, logDepth = true, tolerance, clips, ...options } = look;
    stage.scene.primitives.removeAll();
    stage.scene.logarithmicDepthBuffer = logDepth;
    const set = clips && new ClipSet(clips);
    stage.layer = PointCloudLayer.fromCloud(await this.#cloudOf(tolerance), {
      ...options,
      ...(set && { clips: set }),
    });
    stage.layer.show = empty !== true;
    if (wholeNodes) this.#whole.add(stage.layer);
    stage.scene.primitives.add(stage.layer);
    stage.look(this.#pose);
    await settle(stage, LONGEST_LOADING);
    const { pointsDrawn, nodesLoaded, bytesPerPoint } = stage.layer.statistics;
    const effects = stage.layer.ledger.filter(({ active }) => active).map(({ effect }) => effect);
    return { points: pointsDrawn, nodes: nodesLoaded, bytes: bytesPerPoint, effects };
  }

  /** A look with all points that the pose sees, of one narrow size, and several samples per pixel. */
  async #reference(look: Look): Promise<Picture> {
    const key = JSON.stringify(look);
    const known = this.#references.get(key);
    if (known) return known;
    const limits = { pointBudget: Number.POSITIVE_INFINITY, maximumScreenSpaceError: ALL };
    await this.#draw(this.#fine, {
      ...look,
      ...limits,
      style: { ...look.style, size: "fixed", pointSize: NARROW },
    });
    this.#fine.frame();
    const picture = pictureOf(this.#fine.scene.canvas, SAMPLES);
    this.#references.set(key, picture);
    return picture;
  }

  #picture(side: keyof Pair<unknown>): Picture {
    const stage = this.#stages[side];
    stage.frame();
    return pictureOf(stage.scene.canvas, 1);
  }

  async #time(pairs: number): Promise<Pair<number[]>> {
    const times = { off: [] as number[], on: [] as number[] };
    for (let pair = -WARM_UP; pair < pairs; pair++) {
      // Neither is always the first: what came before a frame is not its own cost.
      for (const side of pair % 2 === 0 ? SIDES : SIDES.toReversed()) {
        const stage = this.#stages[side];
        stage.sway();
        const began = await window.processorTime();
        stage.frame();
        stage.wait();
        if (pair >= 0) times[side].push((await window.processorTime()) - began);
      }
    }
    for (const side of SIDES) this.#stages[side].look(this.#pose);
    return times;
  }
}

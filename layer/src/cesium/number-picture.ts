import { BoundingRectangle } from "cesium";
import { byGroup } from "../drawing/drawn-node.js";
import type { Size } from "../drawing/pick-window.js";
import { type Framebuffer, PassState, type Texture } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { readPixels } from "./engine/pixel-readback.js";
import type { CesiumNode, CesiumView } from "./node-drawable.js";
import type { OffscreenPass, PassSetting } from "./offscreen-pass.js";

/** A window of a picture, pixels of the drawing buffer. */
export interface NumberWindow {
  /** Its lower left corner in the picture; may lie outside. */
  readonly x: number;
  readonly y: number;
  readonly size: Size;
  /** Size of the whole picture. */
  readonly picture: Size;
}

/** A small picture that the numbers of points are drawn into, for picks and measurements. */
export class NumberPicture {
  readonly #objects: GpuObjects;
  readonly #pass: OffscreenPass;
  #target:
    | { readonly colour: Texture; readonly depth: Texture; readonly framebuffer: Framebuffer }
    | undefined;

  constructor(objects: GpuObjects, pass: OffscreenPass) {
    this.#objects = objects;
    this.#pass = pass;
  }

  /**
   * Draws the numbers of the points that show in a window, and reads them back when the GPU has them. Any number of
   * windows can be under way: each is read before the next is drawn.
   * @param nodes at least all that can show in the window
   * @returns RGBA bytes, a number per pixel with its least significant byte first; undefined where it is gone before the
   *   answer comes, or its context is lost
   * @throws the signal's reason when aborted
   */
  read(
    { x, y, size, picture }: NumberWindow,
    nodes: Iterable<CesiumNode>,
    setting: Omit<PassSetting, "target">,
    until: { readonly gone: () => boolean; readonly signal?: AbortSignal | undefined },
  ): Promise<Uint8Array | undefined> {
    const framebuffer = this.#framebuffer(size);
    const target = new PassState(this.#objects.context);
    target.framebuffer = framebuffer;
    // The whole picture, shifted so that the window comes to lie in the corner.
    target.viewport = new BoundingRectangle(-x, -y, picture.width, picture.height);
    this.#pass.clear(this.#objects.context, target);
    this.#pass.draw("id", byGroup<CesiumView>(nodes), { ...setting, target });
    return readPixels(this.#objects, framebuffer, { size, ...until });
  }

  /** Frees what it takes; it is made again when it is next drawn into. */
  release(): void {
    for (const object of [this.#target?.framebuffer, this.#target?.colour, this.#target?.depth]) {
      this.#objects.free(object);
    }
    this.#target = undefined;
  }

  #framebuffer({ width, height }: Size): Framebuffer {
    const there = this.#target;
    if (there?.colour.width === width && there.colour.height === height) return there.framebuffer;
    this.release();
    const colour = this.#objects.colourTexture(width, height, "byte");
    const depth = this.#objects.depthTexture(width, height);
    const framebuffer = this.#objects.framebuffer([colour], depth);
    this.#target = { colour, depth, framebuffer };
    return framebuffer;
  }
}

import { BoundingRectangle } from "cesium";
import { nearestId, type Size } from "../drawing/pick-window.js";
import { type DrawnNode, pointOf } from "./drawn-node.js";
import { type Framebuffer, PassState, type Texture } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { readPixels } from "./engine/pixel-readback.js";
import type { OffscreenPass, PassSetting } from "./offscreen-pass.js";

/** What is asked for: the point nearest to a pixel of the drawing buffer. */
export interface PickRequest {
  /** Pixels, from the lower left. */
  readonly x: number;
  readonly y: number;
  /** Edge of the square around it, pixels; odd. */
  readonly window: number;
  /** Size of the whole picture. */
  readonly size: Size;
  /** All nodes drawn, by rising `firstId`. */
  readonly nodes: readonly DrawnNode[];
  /** Of these, at least all that can show in the window. */
  readonly candidates: readonly DrawnNode[];
  readonly setting: Omit<PassSetting, "target">;
  readonly signal?: AbortSignal | undefined;
}

/** A small picture that numbers are drawn into. */
interface Target {
  readonly colour: Texture;
  readonly depth: Texture;
  readonly framebuffer: Framebuffer;
}

/**
 * Finds drawn points by drawing their numbers into a few pixels around the place asked for. The answer is read back
 * when the GPU has it: nothing waits, and any number of picks can be under way.
 */
export class PointPicker {
  readonly #objects: GpuObjects;
  readonly #pass: OffscreenPass;
  readonly #targets = new Map<number, Target>();
  #destroyed = false;

  constructor(objects: GpuObjects, pass: OffscreenPass) {
    this.#objects = objects;
    this.#pass = pass;
  }

  /**
   * The drawn point nearest to a pixel, as it is drawn: by its size, its shape and what clips and filters leave.
   * @returns undefined where there is none, and where the layer or the GPU goes before the answer comes
   * @throws the signal's reason when aborted
   */
  async pick(
    request: PickRequest,
  ): Promise<{ readonly drawn: DrawnNode; readonly index: number } | undefined> {
    const { window, nodes, signal } = request;
    signal?.throwIfAborted();
    const pixels = await this.#draw(request);
    const id = pixels && nearestId(pixels, window);
    return id ? pointOf(nodes, id - 1) : undefined;
  }

  destroy(): void {
    this.#destroyed = true;
    for (const { framebuffer, colour, depth } of this.#targets.values()) {
      for (const object of [framebuffer, colour, depth]) this.#objects.free(object);
    }
    this.#targets.clear();
  }

  #draw({ x, y, window, size, candidates, setting, signal }: PickRequest): Promise<Uint8Array | undefined> {
    const { context } = setting;
    const { framebuffer } = this.#target(window);
    const reach = (window - 1) / 2;
    const target = new PassState(context);
    target.framebuffer = framebuffer;
    // The whole picture, shifted so that the window comes to lie in the corner.
    target.viewport = new BoundingRectangle(reach - x, reach - y, size.width, size.height);
    this.#pass.clear(context, target, true);
    this.#pass.draw("id", candidates, { ...setting, target });
    const square = { width: window, height: window };
    const answer = readPixels(this.#objects, framebuffer, {
      size: square,
      gone: () => this.#destroyed,
      signal,
    });
    context._gl.flush();
    context.endFrame();
    return answer;
  }

  #target(window: number): Target {
    let target = this.#targets.get(window);
    if (!target) {
      const colour = this.#objects.colourTexture(window, window, "byte");
      const depth = this.#objects.depthTexture(window, window);
      target = { colour, depth, framebuffer: this.#objects.framebuffer([colour], depth) };
      this.#targets.set(window, target);
    }
    return target;
  }
}

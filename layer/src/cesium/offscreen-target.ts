import { BoundingRectangle, Cartesian3 } from "cesium";
import { type Framebuffer, PassState, type PickId, type Texture } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { UniformValues } from "./engine/uniform-values.js";
import type { PointFrustum } from "./point-frustum.js";

/** What a picture of the points alone consists of. */
export interface Picture {
  readonly colour: Texture;
  readonly depth: Texture;
  /** Weighted colours and the sum of weights; only where splats are blended. */
  readonly blended: Texture | undefined;
  /** Draws colours and depth. */
  readonly points: PassState;
  /** Adds up weighted colours under the same depth; only where splats are blended. */
  readonly blending: PassState | undefined;
}

/** A picture of the points alone, as large as the scene's, which a quad then puts into the scene. */
export class OffscreenTarget {
  readonly #objects: GpuObjects;
  #picture: Picture | undefined;
  #framebuffers: Framebuffer[] = [];
  #width = 0;
  #height = 0;

  constructor(objects: GpuObjects) {
    this.#objects = objects;
  }

  /** The picture in the size given; what was in it is gone where the size or the kind is new. */
  prepare(width: number, height: number, blended: boolean): Picture {
    const current = this.#picture;
    const same = this.#width === width && this.#height === height;
    if (current && same && (current.blended !== undefined) === blended) return current;
    this.release();
    const objects = this.#objects;
    const colour = objects.colourTexture(width, height, "byte");
    const depth = objects.depthTexture(width, height);
    const sum = blended ? objects.colourTexture(width, height, "halfFloat") : undefined;
    this.#width = width;
    this.#height = height;
    this.#picture = {
      colour,
      depth,
      blended: sum,
      points: this.#passState(colour, depth),
      blending: sum && this.#passState(sum, depth),
    };
    return this.#picture;
  }

  /** Frees what the picture takes; it is made again when it is next asked for. */
  release(): void {
    for (const framebuffer of this.#framebuffers) this.#objects.free(framebuffer);
    this.#framebuffers = [];
    for (const texture of [this.#picture?.colour, this.#picture?.depth, this.#picture?.blended]) {
      this.#objects.free(texture);
    }
    this.#picture = undefined;
  }

  #passState(colour: Texture, depth: Texture): PassState {
    const framebuffer = this.#objects.framebuffer([colour], depth);
    this.#framebuffers.push(framebuffer);
    const state = new PassState(this.#objects.context);
    state.framebuffer = framebuffer;
    state.viewport = new BoundingRectangle(0, 0, this.#width, this.#height);
    return state;
  }
}

/** Uniforms that the drawing side itself fills: the pick colour, and the picture that a quad reads. */
export class PictureUniforms {
  readonly values: UniformValues;
  readonly #depthRange = new Cartesian3();
  #picture: Picture | undefined;

  constructor(pickId: PickId) {
    this.values = new UniformValues({
      u_pickColor: () => pickId.color,
      u_color: () => this.#picture?.blended ?? this.#picture?.colour,
      u_depth: () => this.#picture?.depth,
      u_depthRange: () => this.#depthRange,
    });
  }

  /** Takes the picture of a frame and the frustum that its depths lie in. */
  take(picture: Picture, { frustum: { near, far }, orthographic }: PointFrustum): void {
    this.#picture = picture;
    const logarithm = orthographic ? 0 : Math.log2(far - near + 1);
    Cartesian3.fromElements(near, far - near, logarithm, this.#depthRange);
  }
}

import { BoundingRectangle, Cartesian3, Cartesian4 } from "cesium";
import { FRONT } from "../effects/index.js";
import { type Framebuffer, PassState, type PickId, type Texture } from "./engine/cesium-private.js";
import type { GpuObjects, TexelType } from "./engine/gpu-objects.js";
import { UniformValues } from "./engine/uniform-values.js";
import type { PointFrustum } from "./point-frustum.js";

/** What a picture of the points alone consists of. */
export interface Picture {
  /** Colours, or weighted colours and the sum of weights where splats are blended. */
  readonly colour: Texture;
  readonly depth: Texture;
  /** What all passes over the points draw into. */
  readonly target: PassState;
}

/** Depths of a picture, copied, so that they can be read while they are drawn against. */
interface Front {
  readonly depth: Texture;
  readonly framebuffer: Framebuffer;
}

/** A picture of the points alone, as large as the scene's, which a quad then puts into the scene. */
export class OffscreenTarget {
  readonly #objects: GpuObjects;
  #picture: (Picture & { readonly framebuffer: Framebuffer; readonly type: TexelType }) | undefined;
  #front: Front | undefined;

  constructor(objects: GpuObjects) {
    this.#objects = objects;
  }

  /** The picture in the size given; what was in it is gone where the size or the kind of colours is new. */
  prepare(width: number, height: number, type: TexelType): Picture {
    const there = this.#picture;
    if (there?.type === type && there.colour.width === width && there.colour.height === height) return there;
    this.release();
    const objects = this.#objects;
    const colour = objects.colourTexture(width, height, type);
    const depth = objects.depthTexture(width, height);
    const framebuffer = objects.framebuffer([colour], depth);
    const target = new PassState(objects.context);
    target.framebuffer = framebuffer;
    target.viewport = new BoundingRectangle(0, 0, width, height);
    this.#picture = { colour, depth, target, framebuffer, type };
    return this.#picture;
  }

  /** Copies the depths of the picture, which is bound to be drawn into, before and after. */
  copyDepth(): Texture | undefined {
    const { framebuffer, depth } = this.#picture ?? {};
    if (!framebuffer || !depth) return undefined;
    const { width, height } = depth;
    this.#front ??= this.#makeFront(width, height);
    this.#objects.copyDepth(framebuffer, this.#front.framebuffer, width, height);
    return this.#front.depth;
  }

  /** Frees what the picture takes; it is made again when it is next asked for. */
  release(): void {
    const { framebuffer, colour, depth } = this.#picture ?? {};
    const front = this.#front;
    for (const object of [framebuffer, colour, depth, front?.framebuffer, front?.depth]) {
      this.#objects.free(object);
    }
    this.#picture = undefined;
    this.#front = undefined;
  }

  #makeFront(width: number, height: number): Front {
    const depth = this.#objects.depthTexture(width, height);
    return { depth, framebuffer: this.#objects.framebuffer([], depth) };
  }
}

/** Uniforms that the drawing side itself fills: the pick colour, and the picture that a quad reads. */
export class PictureUniforms {
  readonly values: UniformValues;
  /** The part of the picture that shows points, as `coveredPart` gives it. */
  readonly coveredPart = new Cartesian4();
  /** Depths that the first pass over the points drew, while later ones draw. */
  front: Texture | undefined;
  readonly #depthRange = new Cartesian3();
  #picture: Picture | undefined;

  constructor(pickId: PickId) {
    this.values = new UniformValues({
      u_pickColor: () => pickId.color,
      u_color: () => this.#picture?.colour,
      u_depth: () => this.#picture?.depth,
      [FRONT]: () => this.front,
      u_depthRange: () => this.#depthRange,
      u_coveredPart: () => this.coveredPart,
    });
  }

  /** Takes the picture of a frame and the frustum that its depths lie in. */
  take(picture: Picture, { frustum: { near, far }, orthographic }: PointFrustum): void {
    this.#picture = picture;
    const logarithm = orthographic ? 0 : Math.log2(far - near + 1);
    Cartesian3.fromElements(near, far - near, logarithm, this.#depthRange);
  }
}

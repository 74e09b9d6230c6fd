import type { GlObjects } from "./gl-objects.js";
import type { GlFramebuffer, GlTexture, PictureFormat } from "./gl-types.js";
import type { PassTarget } from "./point-passes.js";

/** What can be drawn into, and its textures. */
interface Layer {
  readonly colour: GlTexture;
  readonly framebuffer: GlFramebuffer;
}

/** A picture of the points alone: colours with depths and, for blended splats, sums of weighted colours under the same depths. */
export class Picture {
  readonly #objects: GlObjects;
  readonly #format: PictureFormat;
  #depth: GlTexture | undefined;
  #points: Layer | undefined;
  #sums: Layer | undefined;

  constructor(objects: GlObjects, format: PictureFormat = "byte") {
    this.#objects = objects;
    this.#format = format;
  }

  get depth(): GlTexture | undefined {
    return this.#depth;
  }

  /** The colours that were drawn last: the sums where there are some. */
  get colour(): GlTexture | undefined {
    return (this.#sums ?? this.#points)?.colour;
  }

  /** Makes it as large as is asked for; what was in it is gone where size or kind are new. */
  prepare(width: number, height: number, blended: boolean): void {
    const there = this.#depth;
    const same = there?.width === width && there.height === height;
    if (same && (this.#sums !== undefined) === blended) return;
    this.release();
    this.#depth = this.#objects.pictureTexture(width, height, "depth");
    this.#points = this.#layer(width, height, this.#format, this.#depth);
    if (blended) this.#sums = this.#layer(width, height, "halfFloat", this.#depth);
  }

  /** What is drawn into. @param viewport Default: all of it */
  target(of: "points" | "sums" = "points", viewport?: PassTarget["viewport"]): PassTarget {
    const layer = of === "points" ? this.#points : this.#sums;
    const { width = 0, height = 0 } = this.#depth ?? {};
    return { framebuffer: layer?.framebuffer, viewport: viewport ?? [0, 0, width, height] };
  }

  /** Frees what it takes. */
  release(): void {
    for (const layer of [this.#points, this.#sums]) {
      this.#objects.free(layer?.framebuffer);
      this.#objects.free(layer?.colour);
    }
    this.#objects.free(this.#depth);
    this.#depth = undefined;
    this.#points = undefined;
    this.#sums = undefined;
  }

  #layer(width: number, height: number, format: PictureFormat, depth: GlTexture): Layer {
    const colour = this.#objects.pictureTexture(width, height, format);
    return { colour, framebuffer: this.#objects.framebuffer(colour, depth) };
  }
}

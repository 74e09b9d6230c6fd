import type { GlObjects } from "./gl-objects.js";
import type { GlFramebuffer, GlTexture, PictureFormat } from "./gl-types.js";
import type { PassTarget } from "./point-passes.js";

/** What a picture consists of. */
interface Parts {
  readonly format: PictureFormat;
  readonly colour: GlTexture;
  readonly depth: GlTexture;
  readonly framebuffer: GlFramebuffer;
}

/** Depths of a picture, copied, so that they can be read while they are drawn against. */
interface Front {
  readonly depth: GlTexture;
  readonly framebuffer: GlFramebuffer;
}

/** A picture of the points alone: depths, and colours, or sums of weighted colours where splats are blended. */
export class Picture {
  readonly #objects: GlObjects;
  #parts: Parts | undefined;
  #front: Front | undefined;

  constructor(objects: GlObjects) {
    this.#objects = objects;
  }

  get depth(): GlTexture | undefined {
    return this.#parts?.depth;
  }

  get colour(): GlTexture | undefined {
    return this.#parts?.colour;
  }

  /** Makes it as large as is asked for; what was in it is gone where size or format are new. */
  prepare(width: number, height: number, format: PictureFormat): void {
    const there = this.#parts;
    if (there?.format === format && there.depth.width === width && there.depth.height === height) return;
    this.release();
    const depth = this.#objects.pictureTexture(width, height, "depth");
    const colour = this.#objects.pictureTexture(width, height, format);
    this.#parts = { format, colour, depth, framebuffer: this.#objects.framebuffer(colour, depth) };
  }

  /** What is drawn into. @param viewport Default: all of it */
  target(viewport?: PassTarget["viewport"]): PassTarget {
    const { width = 0, height = 0 } = this.depth ?? {};
    return { framebuffer: this.#parts?.framebuffer, viewport: viewport ?? [0, 0, width, height] };
  }

  /** Copies its depths. */
  copyDepth(): GlTexture | undefined {
    const { framebuffer, depth } = this.#parts ?? {};
    if (!framebuffer || !depth) return undefined;
    const { width, height } = depth;
    this.#front ??= this.#makeFront(width, height);
    const { gl } = this.#objects;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, framebuffer.framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.#front.framebuffer.framebuffer);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.DEPTH_BUFFER_BIT, gl.NEAREST);
    return this.#front.depth;
  }

  /** Frees what it takes. */
  release(): void {
    const { framebuffer, colour, depth } = this.#parts ?? {};
    const front = this.#front;
    for (const object of [framebuffer, colour, depth, front?.framebuffer, front?.depth]) {
      this.#objects.free(object);
    }
    this.#parts = undefined;
    this.#front = undefined;
  }

  #makeFront(width: number, height: number): Front {
    const depth = this.#objects.pictureTexture(width, height, "depth");
    return { depth, framebuffer: this.#objects.framebuffer(undefined, depth) };
  }
}

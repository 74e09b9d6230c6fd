import type { Destroyable, GpuBuffer, GpuTexture } from "../drawing/gpu.js";

/** A buffer of WebGL 2. */
export interface GlBuffer extends GpuBuffer {
  readonly buffer: WebGLBuffer;
}

/** A texture of WebGL 2. */
export interface GlTexture extends GpuTexture {
  readonly texture: WebGLTexture;
}

/** A vertex array of WebGL 2, and values that attributes have for all points. */
export interface GlVertexArray extends Destroyable {
  readonly array: WebGLVertexArrayObject;
  readonly constants: readonly { readonly location: number; readonly value: readonly number[] }[];
}

/** What the texels of a picture are stored as. */
export type PictureFormat = "byte" | "halfFloat" | "depth";

/** A picture that can be drawn into. */
export interface GlFramebuffer extends Destroyable {
  readonly framebuffer: WebGLFramebuffer;
}

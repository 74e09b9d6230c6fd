import { PixelDatatype, PixelFormat } from "cesium";
import {
  Buffer,
  BufferUsage,
  type Context,
  DerivedCommand,
  DrawCommand,
  Framebuffer,
  Sampler,
  ShaderProgram,
  ShaderSource,
  Texture,
  VertexArray,
  type VertexAttribute,
} from "./cesium-private.js";

/** Kinds of GPU objects that a layer makes. */
export type GpuKind =
  | "buffers"
  | "vertexArrays"
  | "textures"
  | "framebuffers"
  | "programs"
  | "queries"
  | "fences";

/** How many GPU objects of each kind are alive. */
export type GpuCounts = Readonly<Record<GpuKind, number>>;

/** Nothing on the GPU. */
export const NO_OBJECTS: GpuCounts = {
  buffers: 0,
  vertexArrays: 0,
  textures: 0,
  framebuffers: 0,
  programs: 0,
  queries: 0,
  fences: 0,
};

/** What can be freed. */
interface Destroyable {
  destroy(): void;
}

/** What colours of a texture are stored as. */
export type TexelType = "byte" | "halfFloat";

/** A shader as text: GLSL ES 3.00 bodies in Cesium's terms, and where attributes go in. */
export interface ProgramText {
  readonly vertex: string;
  readonly fragment: string;
  readonly attributes: Readonly<Record<string, number>>;
  readonly defines?: readonly string[];
}

/**
 * Makes all GPU objects of a layer in one context, and knows what is alive: nothing of the layer gets onto the GPU
 * but through here, so the counts are the truth and one call frees all.
 */
export class GpuObjects {
  readonly context: Context;
  readonly #alive = new Map<Destroyable, { readonly kind: GpuKind; readonly bytes: number }>();
  readonly #counts: Record<GpuKind, number> = { ...NO_OBJECTS };
  #bytes = 0;
  /** Cesium caches programs by their text; a program of a context that was lost must not be found again. */
  readonly #generation: string;

  /** @param generation how often the context was lost before */
  constructor(context: Context, generation = 0) {
    this.context = context;
    this.#generation = `GROMA_CONTEXT_${generation}`;
  }

  get counts(): GpuCounts {
    return { ...this.#counts };
  }

  /** Bytes of buffers and textures. */
  get bytes(): number {
    return this.#bytes;
  }

  vertexBuffer(typedArray: ArrayBufferView): Buffer {
    const buffer = Buffer.createVertexBuffer({
      context: this.context,
      typedArray,
      usage: BufferUsage.STATIC_DRAW,
    });
    // Several vertex arrays share one buffer; it is freed by itself.
    buffer.vertexArrayDestroyable = false;
    return this.own("buffers", buffer, buffer.sizeInBytes);
  }

  vertexArray(attributes: readonly VertexAttribute[]): VertexArray {
    return this.own("vertexArrays", new VertexArray({ context: this.context, attributes }));
  }

  /** A texture to draw colours into, read texel by texel. */
  colourTexture(width: number, height: number, type: TexelType): Texture {
    const pixelDatatype = type === "byte" ? PixelDatatype.UNSIGNED_BYTE : PixelDatatype.HALF_FLOAT;
    return this.#texture(width, height, PixelFormat.RGBA, pixelDatatype);
  }

  /** A texture to draw depths into, 24 bits. */
  depthTexture(width: number, height: number): Texture {
    return this.#texture(width, height, PixelFormat.DEPTH_COMPONENT, PixelDatatype.UNSIGNED_INT);
  }

  /** RGBA texels, 8 bits or a float per channel, first row first. */
  dataTexture(width: number, height: number, texels: Uint8Array | Float32Array): Texture {
    const texture = new Texture({
      context: this.context,
      source: { width, height, arrayBufferView: texels },
      pixelFormat: PixelFormat.RGBA,
      pixelDatatype: texels instanceof Float32Array ? PixelDatatype.FLOAT : PixelDatatype.UNSIGNED_BYTE,
      sampler: Sampler.NEAREST,
      flipY: false,
    });
    return this.own("textures", texture, texture.sizeInBytes);
  }

  framebuffer(colours: readonly Texture[], depthTexture: Texture): Framebuffer {
    const framebuffer = new Framebuffer({
      context: this.context,
      colorTextures: colours,
      depthTexture,
      destroyAttachments: false,
    });
    return this.own("framebuffers", framebuffer);
  }

  program({ vertex, fragment, attributes, defines = [] }: ProgramText): ShaderProgram {
    const all = [this.#generation, ...defines];
    const program = ShaderProgram.fromCache({
      context: this.context,
      vertexShaderSource: new ShaderSource({ sources: [vertex], defines: all }),
      fragmentShaderSource: new ShaderSource({ sources: [fragment], defines: all }),
      attributeLocations: attributes,
    });
    return this.own("programs", program);
  }

  /**
   * Has a program compiled and linked now, and not when it first draws.
   * @param owner the primitive
   * @param logarithmic whether Cesium derives a program with logarithmic depth and draws with that
   */
  link(program: ShaderProgram, owner: object, logarithmic: boolean): void {
    const command = new DrawCommand({ owner, shaderProgram: program });
    const drawn = logarithmic ? DerivedCommand.createLogDepthCommand(command, this.context).command : command;
    void drawn.shaderProgram.numberOfVertexAttributes;
  }

  /** Takes an object into the count that was made elsewhere. */
  own<T extends Destroyable>(kind: GpuKind, object: T, bytes = 0): T {
    this.#alive.set(object, { kind, bytes });
    this.#counts[kind]++;
    this.#bytes += bytes;
    return object;
  }

  /** Frees an object; nothing happens where it is free already. */
  free(object: Destroyable | undefined): undefined {
    const entry = object && this.#alive.get(object);
    if (!object || !entry) return undefined;
    this.#alive.delete(object);
    this.#counts[entry.kind]--;
    this.#bytes -= entry.bytes;
    object.destroy();
    return undefined;
  }

  /** Frees all. */
  destroy(): void {
    for (const object of [...this.#alive.keys()]) this.free(object);
  }

  #texture(width: number, height: number, pixelFormat: number, pixelDatatype: number): Texture {
    const texture = new Texture({
      context: this.context,
      width,
      height,
      pixelFormat,
      pixelDatatype,
      sampler: Sampler.NEAREST,
    });
    return this.own("textures", texture, texture.sizeInBytes);
  }
}

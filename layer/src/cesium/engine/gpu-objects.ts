import { ComponentDatatype, PixelDatatype, PixelFormat } from "cesium";
import {
  type Destroyable,
  type Gpu,
  type GpuCounts,
  type GpuKind,
  type GpuTypes,
  NO_OBJECTS,
  type Texels,
  type VertexInput,
} from "../../drawing/gpu.js";
import { PointDraws } from "../../drawing/point-draws.js";
import type { ProgramNeed } from "../../drawing/program-needs.js";
import type { VertexNumbers } from "../../drawing/vertex-numbers.js";
import type { PointShader, ShaderTarget } from "../../effects/index.js";
import type { ColumnData } from "../../workers/index.js";
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
import { programText } from "./program-text.js";
import { CESIUM } from "./shader-target.js";
import { UniformValues } from "./uniform-values.js";

/** What drawing is given of Cesium's objects. */
export interface CesiumTypes extends GpuTypes {
  readonly buffer: Buffer;
  readonly vertexArray: VertexArray;
  readonly texture: Texture;
  readonly program: ShaderProgram;
  readonly uniforms: UniformValues;
}

/** What colours of a texture are stored as. */
export type TexelType = "byte" | "halfFloat";

/** An object that is alive, and how often it was given. */
interface Alive {
  readonly kind: GpuKind;
  readonly bytes: number;
  uses: number;
}

/**
 * Makes all GPU objects of a layer in one context, and knows what is alive: nothing of the layer gets onto the GPU
 * but through here, so the counts are the truth and one call frees all.
 */
export class GpuObjects implements Gpu<CesiumTypes> {
  readonly target: ShaderTarget;
  readonly context: Context;
  readonly draws: PointDraws;
  readonly #owner: object;
  readonly #alive = new Map<Destroyable, Alive>();
  readonly #counts: Record<GpuKind, number> = { ...NO_OBJECTS };
  #bytes = 0;
  /** Cesium caches programs by their text; a program of a context that was lost must not be found again. */
  readonly #generation: string;

  /**
   * @param owner the primitive
   * @param generation how often the context was lost before
   */
  constructor(context: Context, owner: object, generation = 0) {
    this.context = context;
    this.draws = new PointDraws(context._gl);
    this.target = { ...CESIUM, manyDraws: this.draws.many };
    this.#owner = owner;
    this.#generation = `GROMA_CONTEXT_${generation}`;
  }

  get counts(): GpuCounts {
    return { ...this.#counts };
  }

  /** Bytes of buffers and textures. */
  get bytes(): number {
    return this.#bytes;
  }

  vertexBuffer(sizeInBytes: number): Buffer {
    const buffer = Buffer.createVertexBuffer({
      context: this.context,
      sizeInBytes,
      usage: BufferUsage.STATIC_DRAW,
    });
    // Several vertex arrays share one buffer; it is freed by itself.
    buffer.vertexArrayDestroyable = false;
    return this.own("buffers", buffer, buffer.sizeInBytes);
  }

  writeBuffer(buffer: Buffer, data: ColumnData, at: number): void {
    buffer.copyFromArrayView(data, at);
  }

  vertexArray(inputs: readonly VertexInput<Buffer>[]): VertexArray {
    const attributes = inputs.map(vertexAttribute);
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

  dataTexture({ width, height, data }: Texels): Texture {
    const texture = new Texture({
      context: this.context,
      source: { width, height, arrayBufferView: data },
      pixelFormat: PixelFormat.RGBA,
      pixelDatatype: data instanceof Float32Array ? PixelDatatype.FLOAT : PixelDatatype.UNSIGNED_BYTE,
      sampler: Sampler.NEAREST,
      flipY: false,
    });
    return this.own("textures", texture, texture.sizeInBytes);
  }

  writeTexture(texture: Texture, { width, height, data }: Texels): void {
    texture.copyFrom({ source: { width, height, arrayBufferView: data } });
  }

  uniforms(base: UniformValues): UniformValues {
    return new UniformValues(base.map);
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

  /** Copies depths from the framebuffer that is bound into one of the same size, both in pixels; the first one stays bound. */
  copyDepth(from: Framebuffer, to: Framebuffer, width: number, height: number): void {
    const { _gl: gl } = this.context;
    from.bindRead();
    to.bindDraw();
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.DEPTH_BUFFER_BIT, gl.NEAREST);
    from.bindDraw();
  }

  program(shader: PointShader, need: ProgramNeed): ShaderProgram {
    const { vertex, fragment, attributes, defines } = programText(shader, need);
    const all = [this.#generation, ...defines];
    const program = ShaderProgram.fromCache({
      context: this.context,
      vertexShaderSource: new ShaderSource({ sources: [vertex], defines: all }),
      fragmentShaderSource: new ShaderSource({ sources: [fragment], defines: all }),
      attributeLocations: attributes,
    });
    return this.own("programs", program);
  }

  link(program: ShaderProgram, { into, logarithmic }: ProgramNeed): void {
    const command = new DrawCommand({ owner: this.#owner, shaderProgram: program });
    const derived = into === "scene" && logarithmic;
    const drawn = derived ? DerivedCommand.createLogDepthCommand(command, this.context).command : command;
    this.draws.enable();
    // Asking waits for compiler and linker.
    void drawn.shaderProgram.numberOfVertexAttributes;
  }

  /**
   * Takes an object into the count that was made elsewhere. Cesium gives the same program for the same text: it is
   * counted once, and to be freed as often as it was given.
   */
  own<T extends Destroyable>(kind: GpuKind, object: T, bytes = 0): T {
    const there = this.#alive.get(object);
    if (there) {
      there.uses++;
      return object;
    }
    this.#alive.set(object, { kind, bytes, uses: 1 });
    this.#counts[kind]++;
    this.#bytes += bytes;
    return object;
  }

  free(object: Destroyable | undefined): void {
    const entry = object && this.#alive.get(object);
    if (!object || !entry) return;
    entry.uses--;
    if (entry.uses === 0) {
      this.#alive.delete(object);
      this.#counts[entry.kind]--;
      this.#bytes -= entry.bytes;
    }
    object.destroy();
  }

  /** Frees all. */
  destroy(): void {
    for (const object of [...this.#alive.keys()]) {
      while (this.#alive.has(object)) this.free(object);
    }
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

/** What Cesium is told of an attribute: numbers as they are stored. */
export function vertexAttribute(input: VertexInput<Buffer>): VertexAttribute {
  if ("value" in input) return { index: input.location, value: input.value };
  const { location, buffer, numbers, components, normalized } = input;
  return {
    index: location,
    vertexBuffer: buffer,
    componentsPerAttribute: components,
    componentDatatype: DATATYPES[numbers],
    normalize: normalized,
  };
}

const DATATYPES: Readonly<Record<VertexNumbers, number>> = {
  uint8: ComponentDatatype.UNSIGNED_BYTE,
  int8: ComponentDatatype.BYTE,
  uint16: ComponentDatatype.UNSIGNED_SHORT,
  int16: ComponentDatatype.SHORT,
  uint32: ComponentDatatype.UNSIGNED_INT,
  int32: ComponentDatatype.INT,
  float32: ComponentDatatype.FLOAT,
};

import {
  type Destroyable,
  type Gpu,
  type GpuCounts,
  type GpuKind,
  type GpuTypes,
  NO_OBJECTS,
  type Texels,
  type VertexInput,
} from "../drawing/gpu.js";
import { PointDraws } from "../drawing/point-draws.js";
import type { VertexNumbers } from "../drawing/vertex-numbers.js";
import { type PointShader, type ShaderTarget, WEBGL2 } from "../effects/index.js";
import type { ColumnData } from "../workers/index.js";
import { GlProgram } from "./gl-program.js";
import type { GlBuffer, GlFramebuffer, GlTexture, GlVertexArray, PictureFormat } from "./gl-types.js";
import { GlUniforms } from "./gl-uniforms.js";

/** WebGL's numbers of how numbers are stored. */
const TYPES: Readonly<Record<VertexNumbers, number>> = {
  ...{ int8: 0x1400, uint8: 0x1401, int16: 0x1402, uint16: 0x1403 },
  ...{ int32: 0x1404, uint32: 0x1405, float32: 0x1406 },
};

/** What drawing is given of WebGL 2's objects. */
export interface GlTypes extends GpuTypes {
  readonly buffer: GlBuffer;
  readonly vertexArray: GlVertexArray;
  readonly texture: GlTexture;
  readonly program: GlProgram;
  readonly uniforms: GlUniforms;
}

/** Makes all GPU objects of a layer in one context, and knows what is alive. */
export class GlObjects implements Gpu<GlTypes> {
  readonly target: ShaderTarget;
  readonly gl: WebGL2RenderingContext;
  readonly draws: PointDraws;
  readonly #alive = new Map<Destroyable, { readonly kind: GpuKind; readonly bytes: number }>();
  readonly #counts: Record<GpuKind, number> = { ...NO_OBJECTS };
  #bytes = 0;

  constructor(gl: WebGL2RenderingContext) {
    this.gl = gl;
    this.draws = new PointDraws(gl);
    // What belongs to a node comes in a table.
    this.target = { ...WEBGL2, nodeTable: true, manyDraws: this.draws.many };
  }

  get counts(): GpuCounts {
    return { ...this.#counts };
  }

  get bytes(): number {
    return this.#bytes;
  }

  vertexBuffer(bytes: number): GlBuffer {
    const { gl } = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STATIC_DRAW);
    const made = { buffer, sizeInBytes: bytes, destroy: () => gl.deleteBuffer(buffer) };
    return this.own("buffers", made, bytes);
  }

  writeBuffer({ buffer }: GlBuffer, data: ColumnData, at: number): void {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, at, data);
  }

  vertexArray(inputs: readonly VertexInput<GlBuffer>[]): GlVertexArray {
    const { gl } = this;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const constants: { location: number; value: readonly number[] }[] = [];
    for (const input of inputs) {
      if ("value" in input) {
        constants.push(input);
        continue;
      }
      const { location, buffer, numbers, components, normalized } = input;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer.buffer);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, components, TYPES[numbers], normalized, 0, 0);
    }
    gl.bindVertexArray(null);
    return this.own("vertexArrays", { array, constants, destroy: () => gl.deleteVertexArray(array) });
  }

  dataTexture(texels: Texels): GlTexture {
    const { width, height, data } = texels;
    const texture = this.#texture(width, height, data.byteLength);
    this.writeTexture(texture, texels);
    return texture;
  }

  writeTexture({ texture }: GlTexture, { width, height, data }: Texels): void {
    const { gl } = this;
    const float = data instanceof Float32Array;
    const [format, type] = float ? [gl.RGBA32F, gl.FLOAT] : [gl.RGBA8, gl.UNSIGNED_BYTE];
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, gl.RGBA, type, data);
  }

  /** A texture to be drawn into. */
  pictureTexture(width: number, height: number, format: PictureFormat): GlTexture {
    const { gl } = this;
    const made = this.#texture(width, height, width * height * (format === "halfFloat" ? 8 : 4));
    const internal = { byte: gl.RGBA8, halfFloat: gl.RGBA16F, depth: gl.DEPTH_COMPONENT24 }[format];
    gl.texStorage2D(gl.TEXTURE_2D, 1, internal, width, height);
    return made;
  }

  /** @param colour undefined: it has depths alone */
  framebuffer(colour: GlTexture | undefined, depth: GlTexture): GlFramebuffer {
    const { gl } = this;
    const framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    if (colour) {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colour.texture, 0);
    }
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth.texture, 0);
    return this.own("framebuffers", { framebuffer, destroy: () => gl.deleteFramebuffer(framebuffer) });
  }

  uniforms(base: GlUniforms): GlUniforms {
    return new GlUniforms(base);
  }

  program(shader: PointShader): GlProgram {
    this.draws.enable();
    return this.own("programs", new GlProgram(this.gl, shader));
  }

  link(program: GlProgram): void {
    program.link();
  }

  /** Takes an object into the count. */
  own<T extends Destroyable>(kind: GpuKind, object: T, bytes = 0): T {
    this.#alive.set(object, { kind, bytes });
    this.#counts[kind]++;
    this.#bytes += bytes;
    return object;
  }

  free(object: Destroyable | undefined): void {
    const entry = object && this.#alive.get(object);
    if (!object || !entry) return;
    this.#alive.delete(object);
    this.#counts[entry.kind]--;
    this.#bytes -= entry.bytes;
    object.destroy();
  }

  /** Frees all. */
  destroy(): void {
    for (const object of [...this.#alive.keys()]) this.free(object);
  }

  /** A texture that is read texel by texel, bound and without storage. */
  #texture(width: number, height: number, bytes: number): GlTexture {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
    }
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
      gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    }
    return this.own("textures", { texture, width, height, destroy: () => gl.deleteTexture(texture) }, bytes);
  }
}

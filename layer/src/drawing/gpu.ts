import type { PointShader, ShaderTarget } from "../effects/index.js";
import type { ColumnData } from "../workers/index.js";
import type { ProgramNeed } from "./program-needs.js";
import type { VertexNumbers } from "./vertex-numbers.js";

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
export interface Destroyable {
  destroy(): void;
}

/** A buffer of numbers on the GPU. */
export interface GpuBuffer extends Destroyable {
  readonly sizeInBytes: number;
}

/** A texture of RGBA texels. */
export interface GpuTexture extends Destroyable {
  readonly width: number;
  readonly height: number;
}

/** RGBA texels, 8 bits or a float per channel, first row first. */
export interface Texels {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array | Float32Array;
}

/** Values of uniforms by name; matrices are column-major. */
export type UniformNumbers = Readonly<Record<string, number | readonly number[]>>;

/** Uniforms of a layer or of a node, as a program of the view reads them. */
export interface Uniforms<Texture> {
  /** Takes new values; those not named stay. */
  set(values: UniformNumbers): void;
  setTexture(name: string, texture: Texture): void;
}

/** What an attribute of a vertex array reads: the numbers of a buffer, or one value for all points. */
export type VertexInput<Buffer> = { readonly location: number } & (
  | {
      readonly buffer: Buffer;
      /** How they are stored. */
      readonly numbers: VertexNumbers;
      readonly components: number;
      /** Whether integers become 0 to 1. Integers that do not become the float of the same value. */
      readonly normalized: boolean;
    }
  | { readonly value: readonly number[] }
);

/** The types of a graphics library's objects, which drawing hands on and does not look into. */
export interface GpuTypes {
  readonly buffer: GpuBuffer;
  readonly vertexArray: Destroyable;
  readonly texture: GpuTexture;
  readonly program: Destroyable;
  readonly uniforms: Uniforms<this["texture"]>;
}

/**
 * The graphics library of a view, as far as drawing a layer needs it: makes objects in one WebGL 2 context, counts them,
 * and frees them one by one or all together.
 */
export interface Gpu<T extends GpuTypes> {
  /** Whom shaders are written for. */
  readonly target: ShaderTarget;
  /** Bytes of buffers and textures that are alive. */
  readonly bytes: number;
  readonly counts: GpuCounts;
  /** A buffer of so many bytes. */
  vertexBuffer(bytes: number): T["buffer"];
  /** Writes numbers into a buffer, from a byte on. */
  writeBuffer(buffer: T["buffer"], data: ColumnData, at: number): void;
  vertexArray(inputs: readonly VertexInput<T["buffer"]>[]): T["vertexArray"];
  /** A texture that is read texel by texel, without filtering. */
  dataTexture(texels: Texels): T["texture"];
  /** Gives a texture of the same size other texels. */
  writeTexture(texture: T["texture"], texels: Texels): void;
  /** Uniforms on top of others, whose values hold where these have none. */
  uniforms(base: T["uniforms"]): T["uniforms"];
  /** A program, which may be compiled later. A quad over the whole picture has no attributes of points. */
  program(shader: PointShader, need: ProgramNeed): T["program"];
  /** Has a program compiled and linked now, as it will draw what it was made for. */
  link(program: T["program"], need: ProgramNeed): void;
  /** Frees an object; nothing happens where it is free already. */
  free(object: Destroyable | undefined): void;
}

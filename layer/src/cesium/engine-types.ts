import type { BoundingSphere, Camera, Cartesian2, Color, CullingVolume, Matrix4 } from "cesium";

/** Types of what `cesium-private.ts` takes from Cesium; only that file and the augmentation name this one. */

/** `Renderer/Context`: the WebGL context. */
export interface Context {
  readonly drawingBufferHeight: number;
  readonly _gl: { isContextLost(): boolean };
  createPickId(object: object): PickId;
}

/** `Renderer/PickId`: a colour that stands for an object in the pick pass. */
export interface PickId {
  readonly color: Color;
  destroy(): void;
}

/** `Scene/FrameState`: what a primitive is told of the frame. */
export interface FrameState {
  readonly context: Context;
  readonly commandList: DrawCommand[];
  readonly mode: number;
  readonly camera: Camera;
  readonly cullingVolume: CullingVolume;
  /** Present where the globe hides what lies behind it. */
  readonly occluder: object | undefined;
  readonly passes: { readonly render: boolean; readonly pick: boolean; readonly depth: boolean };
  /** Called once the frame is drawn; `true` asks for another frame. */
  readonly afterRender: (() => boolean | undefined)[];
}

/** `Renderer/Buffer`. */
export interface VertexBuffer {
  readonly sizeInBytes: number;
}

/** `Renderer/VertexArray`; destroys the buffers it was made of. */
export interface VertexArray {
  destroy(): void;
}

/** `Renderer/ShaderProgram`, counted by the context's shader cache. */
export interface ShaderProgram {
  destroy(): void;
}

/** `Renderer/RenderState`, shared through a cache. */
export interface RenderState {
  readonly id: number;
}

/** Values of uniforms by name, asked for at each draw. */
export type UniformMap = Readonly<Record<string, () => number | Color | Cartesian2>>;

/** Options of `Renderer/DrawCommand` that the layer sets. */
export interface DrawCommandOptions {
  readonly vertexArray: VertexArray;
  readonly shaderProgram: ShaderProgram;
  readonly renderState: RenderState;
  readonly uniformMap: UniformMap;
  readonly primitiveType: number;
  readonly count: number;
  readonly pass: number;
  readonly modelMatrix: Matrix4;
  readonly boundingVolume: BoundingSphere;
  readonly owner: object;
  /** GLSL expression of the pick colour. */
  readonly pickId: string;
}

/** `Renderer/DrawCommand`. */
export interface DrawCommand {
  shaderProgram: ShaderProgram;
  /** Compared by identity: another matrix has to be another object. */
  modelMatrix: Matrix4;
  boundingVolume: BoundingSphere;
}

/** One attribute of a {@link VertexArray}. */
export interface VertexAttribute {
  readonly index: number;
  readonly vertexBuffer: VertexBuffer;
  readonly componentsPerAttribute: number;
  readonly componentDatatype: number;
  readonly normalize: boolean;
  readonly offsetInBytes: number;
  readonly strideInBytes: number;
}

/** The constructors and enumerations behind those types. */
export interface Engine {
  readonly Buffer: {
    createVertexBuffer(options: {
      context: Context;
      typedArray: ArrayBufferView;
      usage: number;
    }): VertexBuffer;
  };
  readonly BufferUsage: { readonly STATIC_DRAW: number };
  readonly DrawCommand: new (options: DrawCommandOptions) => DrawCommand;
  readonly Pass: { readonly OPAQUE: number };
  readonly RenderState: {
    fromCache(state: { depthTest: { enabled: boolean; func: number } }): RenderState;
    removeFromCache(state: RenderState): void;
  };
  readonly ShaderProgram: {
    fromCache(options: {
      context: Context;
      vertexShaderSource: object;
      fragmentShaderSource: object;
      attributeLocations: Readonly<Record<string, number>>;
    }): ShaderProgram;
  };
  readonly ShaderSource: new (options: { sources: readonly string[]; defines?: readonly string[] }) => object;
  readonly VertexArray: new (options: {
    context: Context;
    attributes: readonly VertexAttribute[];
  }) => VertexArray;
}

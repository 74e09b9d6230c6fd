import type { BoundingRectangle, BoundingSphere, Camera, Color, CullingVolume, Matrix4 } from "cesium";
import type {
  Buffer,
  BufferOptions,
  ContextHandle,
  Framebuffer,
  FramebufferOptions,
  Sampler,
  ShaderProgram,
  ShaderProgramOptions,
  ShaderSource,
  Sync,
  Texture,
  TextureOptions,
  VertexArray,
  VertexAttribute,
} from "./engine-resource-types.js";

/** Types of what `cesium-private.ts` takes from Cesium; only that file and the augmentation name this one. */

/** `Renderer/Context`: the WebGL context. */
export interface Context extends ContextHandle {
  readonly drawingBufferWidth: number;
  readonly drawingBufferHeight: number;
  /** Whether half-float colours can be drawn into. */
  readonly colorBufferHalfFloat: boolean;
  readonly uniformState: UniformState;
  createPickId(object: object): PickId;
  /** Starts the read-back of a rectangle into a buffer on the GPU. */
  readPixelsToPBO(options: {
    readonly x: number;
    readonly y: number;
    readonly width: number;
    readonly height: number;
    readonly framebuffer: Framebuffer;
  }): Buffer;
  /** Unbinds what drawing left bound. */
  endFrame(): void;
}

/** A frustum as the uniforms take it. */
export interface FrustumLike {
  near: number;
  far: number;
  readonly projectionMatrix: Matrix4;
}

/** `Renderer/UniformState`: the values behind `czm_…`. */
export interface UniformState {
  update(frameState: FrameState): void;
  updateFrustum(frustum: FrustumLike): void;
}

/** `Renderer/PickId`: a colour that stands for an object in the pick pass. */
export interface PickId {
  readonly color: Color;
  destroy(): void;
}

/** `Scene/FrameState`: what a primitive is told of the frame. */
export interface FrameState {
  readonly context: Context;
  readonly commandList: Command[];
  readonly mode: number;
  readonly frameNumber: number;
  readonly camera: Camera & { readonly _scene: { requestRender(): void } };
  readonly cullingVolume: CullingVolume;
  readonly pixelRatio: number;
  readonly useLogDepth: boolean;
  /** Present where the globe hides what lies behind it. */
  readonly occluder: object | undefined;
  readonly passes: { readonly render: boolean; readonly pick: boolean; readonly depth: boolean };
  /** Called once the frame is drawn; `true` asks for another frame. */
  readonly afterRender: (() => boolean | undefined)[];
}

/** `Renderer/PassState`: where a command draws, unless it says so itself. */
export interface PassState {
  readonly context: Context;
  framebuffer: Framebuffer | undefined;
  viewport: BoundingRectangle | undefined;
}

/** `Renderer/RenderState`, shared through a cache. */
export interface RenderState {
  readonly id: number;
}

/** The states that the layer sets; what is left out keeps Cesium's default. */
export interface RenderStateOptions {
  readonly depthTest?: { readonly enabled: boolean; readonly func?: number };
  readonly depthMask?: boolean;
  readonly colorMask?: {
    readonly red: boolean;
    readonly green: boolean;
    readonly blue: boolean;
    readonly alpha: boolean;
  };
  readonly blending?: {
    readonly enabled: boolean;
    readonly equationRgb?: number;
    readonly equationAlpha?: number;
    readonly functionSourceRgb?: number;
    readonly functionSourceAlpha?: number;
    readonly functionDestinationRgb?: number;
    readonly functionDestinationAlpha?: number;
  };
}

/** Values of uniforms by name, asked for at each draw. */
export type UniformMap = Readonly<Record<string, () => unknown>>;

/** Options of `Renderer/DrawCommand` that the layer sets. */
export interface DrawCommandOptions {
  readonly vertexArray: VertexArray;
  readonly shaderProgram: ShaderProgram;
  readonly renderState: RenderState;
  readonly uniformMap: UniformMap;
  readonly primitiveType: number;
  readonly count: number;
  readonly pass?: number;
  readonly modelMatrix?: Matrix4;
  readonly boundingVolume?: BoundingSphere;
  readonly owner: object;
  /** GLSL expression of the pick colour. */
  readonly pickId?: string;
}

/** What can stand in a frame's list of commands. */
export interface Command {
  execute(context: Context, passState?: PassState): void;
}

/** `Renderer/DrawCommand`. */
export interface DrawCommand extends Command {
  vertexArray: VertexArray;
  shaderProgram: ShaderProgram;
  renderState: RenderState;
  count: number;
  pass: number;
  /** Compared by identity: another matrix has to be another object. */
  modelMatrix: Matrix4;
  boundingVolume: BoundingSphere;
}

/** `Renderer/ClearCommand`; Cesium executes it in every frustum, in the order of its pass. */
export interface ClearCommand extends Command {
  framebuffer: Framebuffer | undefined;
}

/** Options of `Renderer/ClearCommand`. */
export interface ClearCommandOptions {
  readonly color?: Color;
  readonly depth?: number;
  readonly framebuffer?: Framebuffer;
  readonly pass?: number;
  readonly owner?: object;
}

/** The constructors and enumerations behind those types. */
export interface Engine {
  readonly Buffer: {
    createVertexBuffer(options: BufferOptions): Buffer;
  };
  readonly BufferUsage: { readonly STATIC_DRAW: number };
  readonly ClearCommand: new (options: ClearCommandOptions) => ClearCommand;
  readonly DerivedCommand: {
    /** The command with logarithmic depth; the program is kept with the one that it is derived from. */
    createLogDepthCommand(command: DrawCommand, context: Context): { readonly command: DrawCommand };
  };
  readonly DrawCommand: new (
    options: DrawCommandOptions | Pick<DrawCommandOptions, "owner" | "shaderProgram">,
  ) => DrawCommand;
  readonly Framebuffer: new (options: FramebufferOptions) => Framebuffer;
  readonly Pass: { readonly OPAQUE: number; readonly TRANSLUCENT: number };
  readonly PassState: new (context: Context) => PassState;
  readonly RenderState: {
    fromCache(state: RenderStateOptions): RenderState;
    removeFromCache(state: RenderState): void;
  };
  readonly Sampler: { readonly NEAREST: Sampler };
  readonly ShaderProgram: { fromCache(options: ShaderProgramOptions): ShaderProgram };
  readonly ShaderSource: {
    new (options: { sources: readonly string[]; defines?: readonly string[] }): ShaderSource;
  };
  readonly Sync: { create(options: { context: Context }): Sync };
  readonly Texture: new (options: TextureOptions) => Texture;
  readonly VertexArray: new (options: {
    context: Context;
    attributes: readonly VertexAttribute[];
  }) => VertexArray;
}

/// <reference path="./cesium-augmentation.d.ts" />
import {
  Buffer as EngineBuffer,
  BufferUsage as EngineBufferUsage,
  ClearCommand as EngineClearCommand,
  DerivedCommand as EngineDerivedCommand,
  DrawCommand as EngineDrawCommand,
  Framebuffer as EngineFramebuffer,
  Pass as EnginePass,
  PassState as EnginePassState,
  RenderState as EngineRenderState,
  Sampler as EngineSampler,
  ShaderProgram as EngineShaderProgram,
  ShaderSource as EngineShaderSource,
  Sync as EngineSync,
  Texture as EngineTexture,
  VertexArray as EngineVertexArray,
} from "cesium";
import type * as resources from "./engine-resource-types.js";
import type * as types from "./engine-types.js";

/**
 * Everything the layer uses of Cesium that is exported at run time but not documented, with types of its own.
 * No other file may name it; `cesium-private.test.ts` holds it against the Cesium that is installed.
 */
export type { VertexAttribute } from "./engine-resource-types.js";
export type {
  Command,
  Context,
  FrameState,
  FrustumLike,
  PickId,
  RenderStateOptions,
  UniformMap,
} from "./engine-types.js";

// One constant each, and not an object of them all, so that a bundler can leave out the rest of Cesium.
export const Buffer: types.Engine["Buffer"] = EngineBuffer;
export type Buffer = resources.Buffer;
export const BufferUsage: types.Engine["BufferUsage"] = EngineBufferUsage;
export const ClearCommand: types.Engine["ClearCommand"] = EngineClearCommand;
export type ClearCommand = types.ClearCommand;
export const DerivedCommand: types.Engine["DerivedCommand"] = EngineDerivedCommand;
export const DrawCommand: types.Engine["DrawCommand"] = EngineDrawCommand;
export type DrawCommand = types.DrawCommand;
export const Framebuffer: types.Engine["Framebuffer"] = EngineFramebuffer;
export type Framebuffer = resources.Framebuffer;
export const Pass: types.Engine["Pass"] = EnginePass;
export const PassState: types.Engine["PassState"] = EnginePassState;
export type PassState = types.PassState;
export const RenderState: types.Engine["RenderState"] = EngineRenderState;
export type RenderState = types.RenderState;
export const Sampler: types.Engine["Sampler"] = EngineSampler;
export const ShaderProgram: types.Engine["ShaderProgram"] = EngineShaderProgram;
export type ShaderProgram = resources.ShaderProgram;
export const ShaderSource: types.Engine["ShaderSource"] = EngineShaderSource;
export const Sync: types.Engine["Sync"] = EngineSync;
export type Sync = resources.Sync;
export const Texture: types.Engine["Texture"] = EngineTexture;
export type Texture = resources.Texture;
export const VertexArray: types.Engine["VertexArray"] = EngineVertexArray;
export type VertexArray = resources.VertexArray;

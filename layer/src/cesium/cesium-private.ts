/// <reference path="./cesium-augmentation.d.ts" />
import {
  Buffer as EngineBuffer,
  BufferUsage as EngineBufferUsage,
  DrawCommand as EngineDrawCommand,
  Pass as EnginePass,
  RenderState as EngineRenderState,
  ShaderProgram as EngineShaderProgram,
  ShaderSource as EngineShaderSource,
  VertexArray as EngineVertexArray,
} from "cesium";
import type * as types from "./engine-types.js";

/**
 * Everything the layer uses of Cesium that is exported at run time but not documented, with types of its own.
 * No other file may name it; `cesium-private.test.ts` holds it against the Cesium that is installed.
 */
export type { Context, FrameState, PickId, UniformMap } from "./engine-types.js";

// One constant each, and not an object of them all, so that a bundler can leave out the rest of Cesium.
export const Buffer: types.Engine["Buffer"] = EngineBuffer;
export const BufferUsage: types.Engine["BufferUsage"] = EngineBufferUsage;
export const DrawCommand: types.Engine["DrawCommand"] = EngineDrawCommand;
export type DrawCommand = types.DrawCommand;
export const Pass: types.Engine["Pass"] = EnginePass;
export const RenderState: types.Engine["RenderState"] = EngineRenderState;
export type RenderState = types.RenderState;
export const ShaderProgram: types.Engine["ShaderProgram"] = EngineShaderProgram;
export type ShaderProgram = types.ShaderProgram;
export const ShaderSource: types.Engine["ShaderSource"] = EngineShaderSource;
export const VertexArray: types.Engine["VertexArray"] = EngineVertexArray;

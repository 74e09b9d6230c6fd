import type { Engine } from "./engine-types.js";

/** Cesium exports these at run time; its own declarations leave them out. Seen by this package alone. */
declare module "cesium" {
  export const Buffer: Engine["Buffer"];
  export const BufferUsage: Engine["BufferUsage"];
  export const ClearCommand: Engine["ClearCommand"];
  export const DerivedCommand: Engine["DerivedCommand"];
  export const DrawCommand: Engine["DrawCommand"];
  export const Framebuffer: Engine["Framebuffer"];
  export const Pass: Engine["Pass"];
  export const PassState: Engine["PassState"];
  export const RenderState: Engine["RenderState"];
  export const Sampler: Engine["Sampler"];
  export const ShaderProgram: Engine["ShaderProgram"];
  export const ShaderSource: Engine["ShaderSource"];
  export const Sync: Engine["Sync"];
  export const Texture: Engine["Texture"];
  export const VertexArray: Engine["VertexArray"];
}

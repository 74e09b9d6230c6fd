/** For whom a shader is written: Cesium's preprocessor, or plain WebGL 2. */
export type ShaderTarget = "cesium" | "webgl2";

/** What is drawn: the picture, its depth alone, weighted colours to be blended, or the number of each point. */
export type PointPass = "color" | "depth" | "splat" | "id";

/** A quad over the whole picture. */
export type QuadPass = "edl" | "splatNormalise";

export type UniformType = "float" | "int" | "vec2" | "vec3" | "vec4" | "mat4" | "sampler2D";

/** A uniform and who fills it: the effects (for all nodes or for one), or whoever draws. */
export interface UniformDeclaration {
  readonly name: string;
  readonly type: UniformType;
  /** `layer`: {@link layerUniforms}; `node`: {@link nodeUniforms}; `texture`: by its name; `view`: the drawing side. */
  readonly scope: "layer" | "node" | "texture" | "view";
}

/** A vertex attribute and the column that it reads. */
export interface AttributeDeclaration {
  readonly name: string;
  readonly column: string;
  readonly components: 1 | 2 | 3 | 4;
  /** Whether integers become 0 to 1. Integers that do not become the float of the same value. */
  readonly normalized: boolean;
  readonly location: number;
}

/** A program for points. */
export interface PointShader {
  readonly vertex: string;
  readonly fragment: string;
  readonly attributes: readonly AttributeDeclaration[];
  readonly uniforms: readonly UniformDeclaration[];
}

/** A fragment shader for a quad over the whole picture, which hands it `v_textureCoordinates`. */
export interface QuadShader {
  /** Vertex shader; empty for Cesium, whose viewport quads bring their own. */
  readonly vertex: string;
  readonly fragment: string;
  readonly uniforms: readonly UniformDeclaration[];
}

/** What is drawn: the picture, its depth alone, weighted colours to be blended, or the number of each point. */
export type PointPass = "color" | "depth" | "splat" | "id";

/** Types of GLSL that uniforms have. */
export type UniformType = "float" | "int" | "vec2" | "vec3" | "vec4" | "mat4" | "sampler2D";

/** A uniform and who fills it: the effects (for all nodes or for one), or whoever draws. */
export interface UniformDeclaration {
  readonly name: string;
  readonly type: UniformType;
  /** `layer`: {@link layerUniforms}; `node`: {@link nodeUniforms}; `texture`: by its name; `view`: the drawing side. */
  readonly scope: "layer" | "node" | "texture" | "view";
}

/**
 * Uniforms of a node whose values each frame says anew: the number of its first point among all points drawn, its texel in
 * the texture of the visible octree, and first texel and number of its records in the texture of clips.
 */
export const FIRST_ID = "u_firstId";
export const OCTREE_INDEX = "u_octreeIndex";
export const CLIP_RECORDS = "u_clipRecords";

/** The sampler of the depths that the first pass over the points drew, as large as the picture, while later ones draw. */
export const FRONT = "u_front";

/** Values of uniforms by name; matrices are column-major. */
export type UniformValues = Readonly<Record<string, number | readonly number[]>>;

/**
 * What shaders say as `$word`: the matrices node frame → eye → clip, the viewport, pixels per CSS pixel, and the point's
 * place in the frame that its node has on the globe.
 */
export type ShaderWord = "modelView" | "projection" | "viewport" | "pixelRatio" | "onGlobe";

/** The GLSL of a view: what a shader calls by another name in each, and what a view adds to it. */
export interface ShaderTarget {
  /** First lines of a whole file. */
  readonly header: string;
  /** Line that declares `out_FragColor`; empty where the view does. */
  readonly output: string;
  /** Expressions for the words. */
  readonly words: Readonly<Record<ShaderWord, string>>;
  /** Uniforms of the view's own that the words and the functions below may read; declared where they are read. */
  readonly uniforms: readonly UniformDeclaration[];
  /**
   * Whether what belongs to a node is read from a table of all nodes drawn, so that many are drawn with the same uniforms;
   * else from uniforms of each.
   */
  readonly nodeTable?: boolean;
  /** Whether one call draws many nodes of the table, which follow each other there (`GL_ANGLE_multi_draw`). */
  readonly manyDraws?: boolean;
  /** Lines before the functions of a fragment shader that draws points for the scene. */
  readonly declarations: readonly string[];
  /** Expression for a colour, RGBA, as the view's picture takes it. */
  colour(rgba: string): string;
  /**
   * Statements of a vertex shader that give `gl_Position` the depth of the view's depth buffer where that is not the
   * projection's; empty where it always is. All fragments of a flat point have the depth of its vertex, so that none has
   * to be written, and the GPU can tell what is hidden before a fragment is shaded.
   */
  readonly vertexDepth: string;
  /** Function `void writeDepth(float z)` of a fragment shader: the depth of the eye coordinate z. */
  readonly writeDepth: string;
  /** Function `float eyeZ(float depth)`: the eye coordinate z of a depth that was drawn offscreen. */
  readonly eyeZ: string;
  /** The quad that puts an offscreen picture into the scene. */
  readonly quad: {
    /** Vertex shader, which hands `v_textureCoordinates` on. */
    readonly vertex: string;
    /** Functions that {@link depth} calls. */
    readonly functions: readonly string[];
    /** Statements that write the depth of the scene, of `depth` in the picture. */
    readonly depth: string;
  };
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

/** A program for a quad over the whole picture. */
export interface QuadShader {
  readonly vertex: string;
  readonly fragment: string;
  readonly uniforms: readonly UniformDeclaration[];
}

/** A texture that a program reads by texel, without filtering or mipmaps. */
export interface TextureData {
  /** Name of the sampler. */
  readonly name: string;
  readonly width: number;
  readonly height: number;
  /** RGBA, 8 bits each (`Uint8Array`) or floats (`Float32Array`: RGBA32F), row by row. */
  readonly data: Uint8Array | Float32Array;
}

/** Columns whose names are fit for GLSL as they stand; extra bytes may be called anything. */
const PLAIN = /^[A-Za-z][A-Za-z0-9]*$/;

/** GLSL name of the attribute that reads a column. Unfit names are told by their characters' codes, each in its own way. */
export function attributeName(column: string): string {
  if (PLAIN.test(column)) return `a_${column}`;
  const codes = [...column].map((character) =>
    /[A-Za-wyz0-9]/.test(character) ? character : `x${character.codePointAt(0)!.toString(16)}x`,
  );
  // No plain name begins with a digit.
  return `a_0${codes.join("")}`;
}

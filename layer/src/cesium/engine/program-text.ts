import { isQuad, type ProgramNeed } from "../../drawing/program-needs.js";
import type { PointShader } from "../../effects/index.js";

/** A program as text: GLSL ES 3.00 bodies in Cesium's terms, and where attributes go in. */
export interface ProgramText {
  readonly vertex: string;
  readonly fragment: string;
  readonly attributes: Readonly<Record<string, number>>;
  readonly defines: readonly string[];
}

/** What Cesium is to compile for a shader. What draws into its scene it derives with `LOG_DEPTH` itself where it needs that. */
export function programText(shader: PointShader, need: ProgramNeed): ProgramText {
  const { vertex, fragment } = shader;
  if (isQuad(need)) return { vertex, fragment, attributes: { a_corner: 0 }, defines: [] };
  const attributes = Object.fromEntries(shader.attributes.map(({ name, location }) => [name, location]));
  // Shaders write logarithmic depth themselves, where this is defined.
  const defines = need.into === "own" && need.logarithmic ? ["LOG_DEPTH"] : [];
  return { vertex, fragment, attributes, defines };
}

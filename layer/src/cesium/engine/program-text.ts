import { isQuad, type ProgramNeed } from "../../drawing/program-needs.js";
import type { PointShader } from "../../effects/index.js";
import { ShaderSource } from "./cesium-private.js";

/** A program as text: GLSL ES 3.00 bodies in Cesium's terms, and where attributes go in. */
export interface ProgramText {
  readonly vertex: string;
  readonly fragment: string;
  readonly attributes: Readonly<Record<string, number>>;
  readonly defines: readonly string[];
}

/** What Cesium is to compile for a shader. It adds logarithmic depth itself to what draws into its scene. */
export function programText(shader: PointShader, need: ProgramNeed): ProgramText {
  const { vertex, fragment } = shader;
  if (isQuad(need)) return { vertex, fragment, attributes: { a_corner: 0 }, defines: [] };
  const attributes = Object.fromEntries(shader.attributes.map(({ name, location }) => [name, location]));
  const logarithmic = need.into === "own" && need.logarithmic;
  return logarithmic
    ? { ...withLogarithmicDepth(vertex, fragment), attributes, defines: ["LOG_DEPTH"] }
    : { vertex, fragment, attributes, defines: [] };
}

/** What Cesium makes of a program whose depth is to be logarithmic (`Scene/DerivedCommand`). */
function withLogarithmicDepth(vertex: string, fragment: string) {
  const wrap = (text: string, call: string) =>
    `${ShaderSource.replaceMain(text, "groma_main")}\nvoid main() {\n  groma_main();\n  ${call}();\n}\n`;
  return {
    vertex: wrap(vertex, "czm_vertexLogDepth"),
    // Paraboloids write their depth themselves.
    fragment: /\bczm_writeLogDepth\(/.test(fragment) ? fragment : wrap(fragment, "czm_writeLogDepth"),
  };
}

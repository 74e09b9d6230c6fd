import { attributeName } from "./attribute-names.js";
import { EFFECTS } from "./catalogue.js";
import type { EffectPlan } from "./effect-plan.js";
import { includeChunks } from "./include.js";
import {
  FRAGMENT_STAGES,
  type Part,
  type PartContext,
  SHARED_STAGES,
  type Varying,
  VERTEX_STAGES,
} from "./part.js";
import { basePart } from "./parts/base.js";
import type {
  AttributeDeclaration,
  PointPass,
  PointShader,
  ShaderTarget,
  UniformDeclaration,
} from "./shader-target.js";
import { translateWords } from "./target-words.js";

/** First lines of a whole file; Cesium writes its own. */
export const WEBGL2_HEADER = "#version 300 es\nprecision highp float;\nprecision highp int;\n";

/**
 * The program of a set of effects: what each of them adds, in the order of the stages, and nothing of the others.
 * Uniforms and attributes begin with `u_` and `a_`, varyings with `v_`.
 * @param pass Default: `color`
 */
export function composePointShader(
  plan: EffectPlan,
  target: ShaderTarget,
  pass: PointPass = "color",
): PointShader {
  const context: PartContext = { plan, target, pass, attribute: attributeName };
  const parts: Part[] = [basePart(context)];
  for (const effect of EFFECTS) {
    const part = plan.active.has(effect.name) ? effect.part?.(context) : undefined;
    if (part) parts.push(part);
  }
  const attributes = attributesOf(parts);
  const uniforms = unique(parts.flatMap((part) => part.uniforms ?? []));
  const varyings = unique(parts.flatMap((part) => part.varyings ?? []));
  const vertexBody = VERTEX_STAGES.flatMap((stage) =>
    statements(
      stage,
      parts.map((part) => part.vertex?.[stage]),
    ),
  );
  const fragmentBody = FRAGMENT_STAGES.flatMap((stage) =>
    statements(
      stage,
      parts.map((part) => part.fragment?.[stage]),
    ),
  );
  const vertex = shaderText(
    target,
    uniforms,
    [...attributes.map(attributeLine), ...varyings.map((varying) => varyingLine(varying, "out"))],
    parts.map((part) => part.vertexFunctions),
    vertexBody,
  );
  const output = target === "webgl2" ? ["layout(location = 0) out vec4 out_FragColor;"] : [];
  const fragment = shaderText(
    target,
    uniforms,
    [
      ...varyings.map((varying) => varyingLine(varying, "in")),
      ...parts.flatMap((part) => part.fragmentDeclarations ?? []),
      ...output,
    ],
    parts.map((part) => part.fragmentFunctions),
    fragmentBody,
  );
  const declared = unique([...uniforms, ...vertex.uniforms, ...fragment.uniforms]);
  const used = declared.filter(({ name }) => mentions(vertex.text, name) || mentions(fragment.text, name));
  return { vertex: vertex.text, fragment: fragment.text, attributes, uniforms: used };
}

/**
 * A shader's text from its declarations, functions and the statements of `main`, with words and includes resolved.
 * Only the uniforms that the text mentions are declared.
 */
export function shaderText(
  target: ShaderTarget,
  uniforms: readonly UniformDeclaration[],
  declarations: readonly string[],
  functions: readonly (string | undefined)[],
  body: readonly string[],
): { readonly text: string; readonly uniforms: readonly UniformDeclaration[] } {
  const main = `void main() {\n${body.map((line) => `  ${line}\n`).join("")}}\n`;
  const wanted = [...new Set(functions.filter((text) => text !== undefined).map((text) => text.trim()))];
  const whole = translateWords(`${includeChunks(`${wanted.join("\n")}\n`)}${main}`, target);
  const lines = unique([...uniforms, ...whole.uniforms])
    .filter(({ name }) => mentions(whole.text, name))
    .map(uniformLine);
  const header = target === "webgl2" ? WEBGL2_HEADER : "";
  const head = [...declarations, ...lines].map((line) => `${line}\n`).join("");
  return { text: `${header}${head}\n${whole.text.trimStart()}`, uniforms: whole.uniforms };
}

function statements(stage: string, texts: readonly (string | undefined)[]): string[] {
  const lines = texts.flatMap((text) => (text ? text.trim().split("\n") : []));
  return SHARED_STAGES.includes(stage) ? [...new Set(lines)] : lines;
}

/** Position first, then columns in the order of their effects, each once. */
function attributesOf(parts: readonly Part[]): AttributeDeclaration[] {
  const uses = new Map(
    parts.flatMap((part) => part.attributes ?? []).map((use) => [use.column, use] as const),
  );
  return [...uses.values()].map((use, location) => ({ ...use, name: attributeName(use.column), location }));
}

/** One of each name. */
function unique<T extends { readonly name: string }>(items: readonly T[]): T[] {
  return [...new Map(items.map((item) => [item.name, item] as const)).values()];
}

function mentions(text: string, name: string): boolean {
  return new RegExp(`\\b${name}\\b`).test(text);
}

function attributeLine({ name, components }: AttributeDeclaration): string {
  return `in ${components === 1 ? "float" : `vec${components}`} ${name};`;
}

function varyingLine({ name, type, flat }: Varying, direction: "in" | "out"): string {
  return `${flat ? "flat " : ""}${direction} ${type === "uint" ? "highp uint" : type} ${name};`;
}

/** Samplers default to low precision, which is not enough for indices. */
function uniformLine({ name, type }: UniformDeclaration): string {
  return `uniform ${type === "sampler2D" ? "highp sampler2D" : type} ${name};`;
}

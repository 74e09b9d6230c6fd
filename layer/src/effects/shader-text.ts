import type { ShaderTarget, ShaderWord, UniformDeclaration } from "./declaration/shader.js";

/** What the `main` of a shader is written from. */
export interface ShaderSource {
  /** Uniforms that may be read. */
  readonly uniforms: readonly UniformDeclaration[];
  /** Lines before them: what comes in and goes out. */
  readonly declarations: readonly string[];
  /** Functions; what several effects need comes in once. */
  readonly functions: readonly string[];
  readonly statements: readonly string[];
}

/** A shader's text: only the uniforms that it reads are declared, and words are what the target calls them. */
export function shaderText(target: ShaderTarget, source: ShaderSource): string {
  const functions = [...new Set(source.functions.map((text) => text.trim()))];
  const main = `void main() {\n${source.statements.map((line) => `  ${line}\n`).join("")}}\n`;
  const body = [...functions, main].join("\n").replace(/\$([A-Za-z]+)/g, (_, word: ShaderWord) => {
    if (!Object.hasOwn(target.words, word)) throw new Error(`shaders know no word $${word}`);
    return target.words[word];
  });
  const uniforms = readBy(body, [...source.uniforms, ...target.uniforms]);
  const head = [...source.declarations, ...uniforms.map(uniformLine)].map((line) => `${line}\n`).join("");
  return `${target.header}${head}\n${body}`;
}

/** Statements of one stage after the other. @param shared stages whose lines come in once */
export function stagedStatements<Stage extends string>(
  stages: readonly Stage[],
  parts: readonly (Partial<Record<Stage, string>> | undefined)[],
  shared: readonly string[] = [],
): string[] {
  return stages.flatMap((stage) => {
    const lines = parts.flatMap((part) => part?.[stage]?.trim().split("\n") ?? []);
    return shared.includes(stage) ? [...new Set(lines)] : lines;
  });
}

/** The uniforms that a text mentions, each name once. */
export function readBy(text: string, uniforms: readonly UniformDeclaration[]): UniformDeclaration[] {
  return unique(uniforms).filter(({ name }) => new RegExp(`\\b${name}\\b`).test(text));
}

/** One of each name. */
export function unique<T extends { readonly name: string }>(items: readonly T[]): T[] {
  return [...new Map(items.map((item) => [item.name, item] as const)).values()];
}

/** Samplers default to low precision, which is not enough for indices. */
function uniformLine({ name, type }: UniformDeclaration): string {
  return `uniform ${type === "sampler2D" ? "highp sampler2D" : type} ${name};`;
}

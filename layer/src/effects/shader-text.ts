import type { ShaderTarget, ShaderWord, UniformDeclaration } from "./declaration/shader.js";
import { type NodeLayout, nodeReading } from "./node-layout.js";

/** What the `main` of a shader is written from. */
export interface ShaderSource {
  /** Uniforms that may be read. */
  readonly uniforms: readonly UniformDeclaration[];
  /** Lines before them: what comes in and goes out. */
  readonly declarations: readonly string[];
  /** Functions; what several effects need comes in once. */
  readonly functions: readonly string[];
  readonly statements: readonly string[];
  /** Where what belongs to nodes is read from, where that is no uniform of each. */
  readonly nodes?: NodeLayout | undefined;
}

/** A shader's text: only the uniforms that it reads are declared, and words are what the target calls them. */
export function shaderText(target: ShaderTarget, source: ShaderSource): string {
  const worded = (text: string) =>
    text.replace(/\$([A-Za-z]+)/g, (_, word: ShaderWord) => {
      if (!Object.hasOwn(target.words, word)) throw new Error(`shaders know no word $${word}`);
      return target.words[word];
    });
  const functions = [...new Set(source.functions.map((text) => text.trim()))].map(worded);
  const statements = source.statements.map(worded);
  const read = readBy([...functions, ...statements].join("\n"), [...source.uniforms, ...target.uniforms]);
  const inTable = (uniform: UniformDeclaration) => source.nodes !== undefined && uniform.scope === "node";
  const { manyDraws } = target;
  const nodes = source.nodes && nodeReading(source.nodes, read.filter(inTable), manyDraws);
  const uniforms = [...read.filter((uniform) => !inTable(uniform)), ...(nodes?.uniforms ?? [])];
  const lines = [...(nodes?.statements ?? []), ...statements].map((line) => `  ${line}\n`);
  const head = [...source.declarations, ...uniforms.map(uniformLine), ...(nodes?.globals ?? [])];
  const body = [...functions, `void main() {\n${lines.join("")}}\n`].join("\n");
  const header = nodes && manyDraws ? extended(target.header) : target.header;
  return `${header}${head.map((line) => `${line}\n`).join("")}\n${body}`;
}

/** First lines of a shader that reads the number of a draw: what it takes for that comes before all but the version. */
function extended(header: string): string {
  return header.replace(/^(#version .*\n)?/, "$1#extension GL_ANGLE_multi_draw : require\n");
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

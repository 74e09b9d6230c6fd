import type { EffectPlan } from "./effect-plan.js";
import type { PointPass, ShaderTarget, UniformDeclaration } from "./shader-target.js";

/**
 * Where in the vertex shader's `main` statements go, in this order: what is known of the point (`locate`), whether it is
 * drawn, its colour, its place on screen, what is known there (`measure`), its size, shifts, and what fragments get.
 */
export const VERTEX_STAGES = [
  "locate",
  "cull",
  "color",
  "project",
  "measure",
  "size",
  "place",
  "hand",
] as const;
/** Stages whose lines several effects may need and that come in once. */
export const SHARED_STAGES: readonly string[] = ["locate", "measure"];
/** Where in the fragment shader's `main` statements go, in this order. */
export const FRAGMENT_STAGES = ["shape", "output", "finish", "depth"] as const;

export type VertexStage = (typeof VERTEX_STAGES)[number];
export type FragmentStage = (typeof FRAGMENT_STAGES)[number];

/** A value that goes from the vertex to the fragment shader. */
export interface Varying {
  readonly name: string;
  readonly type: "float" | "vec2" | "vec3" | "vec4" | "uint";
  readonly flat?: boolean;
}

/** What one effect adds to a program. Functions may `#include <chunk>`; each chunk comes in once. */
export interface Part {
  readonly attributes?: readonly {
    readonly column: string;
    readonly components: 1 | 2 | 3 | 4;
    readonly normalized: boolean;
  }[];
  readonly uniforms?: readonly UniformDeclaration[];
  readonly varyings?: readonly Varying[];
  /** Lines before the functions of the fragment shader. */
  readonly fragmentDeclarations?: readonly string[];
  readonly vertexFunctions?: string;
  readonly vertex?: Partial<Record<VertexStage, string>>;
  readonly fragmentFunctions?: string;
  readonly fragment?: Partial<Record<FragmentStage, string>>;
}

/** What a part is written for. */
export interface PartContext {
  readonly plan: EffectPlan;
  readonly target: ShaderTarget;
  readonly pass: PointPass;
  /** GLSL name of the attribute that reads a column. */
  attribute(column: string): string;
}

/** Whether a pass shows colours. */
export function showsColour(pass: PointPass): boolean {
  return pass === "color" || pass === "splat";
}

import { type EffectPlan, type PointPass, passesOf, withoutClips } from "../effects/index.js";

/** Where depth is logarithmic: in pictures of the layer's own, and in the view's scene. */
export interface LogarithmicDepth {
  readonly own: boolean;
  readonly scene: boolean;
}

/** A program for points. */
export interface PointProgramNeed {
  readonly pass: PointPass;
  readonly plan: EffectPlan;
  /** What it draws into: the view's scene, by the view's own commands, or a picture of the layer's. */
  readonly into: "scene" | "own";
  /** Whether the depth there is logarithmic. */
  readonly logarithmic: boolean;
}

/** A program for a quad that puts a picture of the layer's into the view's scene. */
export interface QuadProgramNeed {
  readonly pass: "quad";
  readonly plan: EffectPlan;
  readonly into: "scene";
  readonly logarithmic: boolean;
}

/** A program that a set of effects is drawn with. */
export type ProgramNeed = PointProgramNeed | QuadProgramNeed;

/** Whether a program is for a quad over the whole picture. */
export function isQuad(need: ProgramNeed): need is QuadProgramNeed {
  return need.pass === "quad";
}

/** The program for the quad that puts their picture into the scene. */
export function quadProgramOf(plan: EffectPlan, depth: LogarithmicDepth): QuadProgramNeed {
  return { plan, pass: "quad", into: "scene", logarithmic: depth.scene };
}

/** The programs for the points of a set of effects: nodes that no volume touches are drawn without clips. */
export function pointProgramsOf(plan: EffectPlan, depth: LogarithmicDepth): PointProgramNeed[] {
  const plans = [...new Set([plan, withoutClips(plan)])];
  const { points, offscreen } = passesOf(plan);
  if (!offscreen) {
    return plans.map((plan) => ({ plan, pass: "color", into: "scene", logarithmic: depth.scene }));
  }
  return plans.flatMap((plan) =>
    points.map((pass) => ({ plan, pass, into: "own", logarithmic: depth.own }) as const),
  );
}

/** The programs that draw the numbers of a material's points, for picks and measurements. */
export function numberProgramsOf(plan: EffectPlan, depth: LogarithmicDepth): PointProgramNeed[] {
  const plans = [...new Set([plan, withoutClips(plan)])];
  return plans.map((plan) => ({ plan, pass: "id", into: "own", logarithmic: depth.own }));
}

/** All programs of a set of effects that make its picture. */
export function programsOf(plan: EffectPlan, depth: LogarithmicDepth): ProgramNeed[] {
  const points = pointProgramsOf(plan, depth);
  return passesOf(plan).offscreen ? [...points, quadProgramOf(plan, depth)] : points;
}

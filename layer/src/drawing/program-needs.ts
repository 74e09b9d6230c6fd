import {
  drawsOffscreen,
  type EffectPlan,
  type PointPass,
  type QuadPass,
  withoutClips,
} from "../effects/index.js";

/** Who draws with a program: Cesium, which derives others from it, or the layer itself. */
export type Drawer = "scene" | "own";

/** A program for points. */
export interface PointProgramNeed {
  readonly pass: PointPass;
  readonly plan: EffectPlan;
  readonly drawer: Drawer;
  /** Whether it writes logarithmic depth; Cesium adds that itself where it draws. */
  readonly logarithmic: boolean;
}

/** A program that a set of effects is drawn with. */
export type ProgramNeed =
  | PointProgramNeed
  | { readonly pass: QuadPass; readonly plan: EffectPlan; readonly drawer: "quad" };

/** The passes over the points that make their picture. */
export function passesOf({ active }: EffectPlan): readonly [PointPass, ...PointPass[]] {
  return active.has("splats") ? ["depth", "splat"] : ["color"];
}

/** The pass that puts their picture into the scene. */
export function quadPassOf({ active }: EffectPlan): QuadPass {
  return active.has("eyeDomeLighting") ? "edl" : "splatNormalise";
}

/** The programs for the points of a set of effects: nodes that no volume touches are drawn without clips. */
export function pointProgramsOf(plan: EffectPlan, logarithmic: boolean): PointProgramNeed[] {
  const plans = new Set([plan, withoutClips(plan)]);
  if (!drawsOffscreen(plan)) {
    return [...plans].map((plan) => ({ plan, pass: "color", drawer: "scene", logarithmic: false }));
  }
  return [...plans].flatMap((plan) =>
    passesOf(plan).map((pass) => ({ plan, pass, drawer: "own", logarithmic }) as const),
  );
}

/** The programs that draw the numbers of a look's points, for picks and measurements. */
export function numberProgramsOf(plan: EffectPlan, logarithmic: boolean): PointProgramNeed[] {
  const plans = new Set([plan, withoutClips(plan)]);
  return [...plans].map((plan) => ({ plan, pass: "id", drawer: "own", logarithmic }));
}

/** All programs of a set of effects that make its picture. */
export function programsOf(plan: EffectPlan, logarithmic: boolean): ProgramNeed[] {
  const points = pointProgramsOf(plan, logarithmic);
  return drawsOffscreen(plan) ? [...points, { plan, pass: quadPassOf(plan), drawer: "quad" }] : points;
}

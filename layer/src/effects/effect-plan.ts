import type { PointFilter } from "./filter.js";

/** Everything that could be drawn or left out, in the order of the ledger. */
export const EFFECT_NAMES = [
  "ownColour",
  "gradient",
  "classification",
  "levelOfDetail",
  "blend",
  "tone",
  "dithering",
  "fixedSize",
  "attenuatedSize",
  "adaptiveSize",
  "disc",
  "paraboloid",
  "splats",
  "eyeDomeLighting",
  "opacity",
  "clip",
  "highlight",
  "filter",
] as const;

export type EffectName = (typeof EFFECT_NAMES)[number];

/** What an effect takes, measured. */
export interface MeasuredCost {
  /** Below zero where it takes less with the effect than without, as where fewer fragments are left to draw. */
  readonly value: number;
  readonly unit: "ms per frame" | "ns per point" | "bytes";
  /** How it was measured. */
  readonly by: "timer query" | "frame difference" | "count";
}

/** One line of `layer.ledger`. */
export interface LedgerRow {
  /** An {@link EffectName}, or the name of an effect of placing. */
  readonly effect: string;
  /** How much the picture or the place would change without it; NaN where the facts do not say. */
  readonly magnitude: number;
  readonly unit: string;
  /** What the magnitude is held against. */
  readonly threshold: number;
  readonly active: boolean;
  readonly why: string;
  /** Formula of the magnitude and where it comes from. */
  readonly source: string;
  /** Undefined until measured; inactive effects cost nothing. */
  readonly cost: MeasuredCost | undefined;
}

/** Where a colour comes from: the scan, a scalar column, the classes, the level of detail. */
export interface Colouring {
  readonly kind: "own" | "scalar" | "class" | "level";
  /** The column read; undefined for the level of detail. */
  readonly column: string | undefined;
}

/** The effects that a scene calls for, and why. */
export interface EffectPlan {
  readonly active: ReadonlySet<EffectName>;
  /** Same key, same programs. */
  readonly key: string;
  readonly ledger: readonly LedgerRow[];
  /** One, or the two that are blended. */
  readonly colourings: readonly Colouring[];
  /** What the filter asks for: classes, kinds of returns, columns that it holds against ranges. */
  readonly filters: {
    readonly classes: boolean;
    readonly returns: boolean;
    readonly ranges: readonly string[];
    /** The filter itself; its numbers are no part of the program. */
    readonly filter: PointFilter | undefined;
  };
  /** Neighbours of Eye-Dome Lighting. */
  readonly neighbours: 4 | 8;
}

/**
 * Whether points are drawn into a picture of their own that a quad then puts into the scene. A translucent cloud is one
 * picture that lets the scene through: points that were translucent one by one would add up to an opaque heap.
 */
export function drawsOffscreen({ active }: Pick<EffectPlan, "active">): boolean {
  return active.has("splats") || active.has("eyeDomeLighting") || active.has("opacity");
}

import type { Effect } from "../declaration/effect.js";
import { adaptiveSize } from "./adaptive-size.js";
import { attenuatedSize } from "./attenuated-size.js";
import { blend } from "./blend.js";
import { classification } from "./classification.js";
import { clip } from "./clip.js";
import { disc } from "./disc.js";
import { dithering } from "./dithering.js";
import { eyeDomeLighting } from "./eye-dome-lighting.js";
import { filter } from "./filter.js";
import { fixedSize } from "./fixed-size.js";
import { gradient } from "./gradient.js";
import { highlight } from "./highlight.js";
import { levelOfDetail } from "./level-of-detail.js";
import { opacity } from "./opacity.js";
import { paraboloid } from "./paraboloid.js";
import { rgb } from "./rgb.js";
import { splats } from "./splats.js";
import { tone } from "./tone.js";

/** All effects, in the order in which they stand in a program and in the ledger. */
const CATALOGUE = [
  ...([rgb, gradient, classification, levelOfDetail, blend, tone] as const),
  ...([fixedSize, attenuatedSize, adaptiveSize] as const),
  ...([disc, paraboloid, splats, eyeDomeLighting, opacity, dithering] as const),
  ...([clip, highlight, filter] as const),
] as const;

type Signatures = (typeof CATALOGUE)[number] extends infer Each
  ? Each extends Effect<infer Signature>
    ? Signature
    : never
  : never;

/** What each of some types has, all in one. */
type All<Union> = (Union extends unknown ? (each: Union) => void : never) extends (all: infer Whole) => void
  ? Whole
  : never;

type Owns<Signature> = Signature extends { readonly own: infer Own } ? Own : never;
type Words<Signature, Property extends string> = Signature extends {
  readonly words: Readonly<Record<Property, infer Word>>;
}
  ? Word
  : never;

/** Everything that could be drawn or left out. */
export type EffectName = Signatures["name"];

/**
 * What a point's colour shows: the scan's own colours (`rgb`), the level of the most detailed node drawn around the
 * point, or the name of an attribute (`elevation`, `intensity`, `classification`, `gpsTime`, any extra byte …).
 */
export type ColourBy =
  | Words<Signatures, "color">
  | "elevation"
  | "intensity"
  | "classification"
  | (string & {});

/** How the size of a point comes about (thesis, 4.3). */
export type SizeMode = Words<Signatures, "size">;

/** What a point is drawn as (thesis, 4.2). */
export type PointShape = "square" | Words<Signatures, "shape">;

/** How points are drawn. Each effect declares its own properties. */
export interface PointCloudStyle extends All<Owns<Signatures>> {
  /** Default: `rgb` where the scan has colours, else `elevation`. */
  readonly color: ColourBy;
  /** Default: `fixed`. */
  readonly size: SizeMode;
  /** Default: `square`. */
  readonly shape: PointShape;
}

/** An effect as the planner and the composer take it. */
export type AnyEffect = Effect<{
  name: EffectName;
  reads: PointCloudStyle;
  words: Partial<Record<"color" | "size" | "shape", string>>;
  variant: unknown;
}>;

/** All effects, in the order in which they stand in a program and in the ledger. */
export const EFFECTS: readonly AnyEffect[] = CATALOGUE;

/** Names of all effects, in the order of the ledger. */
export const EFFECT_NAMES: readonly EffectName[] = EFFECTS.map(({ name }) => name);

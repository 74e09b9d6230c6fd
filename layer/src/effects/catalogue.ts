import type { Effect } from "./effect.js";
import { adaptiveSize } from "./parts/adaptive-size.js";
import { attenuatedSize } from "./parts/attenuated-size.js";
import { blend } from "./parts/blend.js";
import { classification } from "./parts/classification.js";
import { clip } from "./parts/clip.js";
import { disc } from "./parts/disc.js";
import { dithering } from "./parts/dithering.js";
import { eyeDomeLighting } from "./parts/eye-dome-lighting.js";
import { filter } from "./parts/filter.js";
import { fixedSize } from "./parts/fixed-size.js";
import { gradient } from "./parts/gradient.js";
import { highlight } from "./parts/highlight.js";
import { levelOfDetail } from "./parts/level-of-detail.js";
import { opacity } from "./parts/opacity.js";
import { ownColour } from "./parts/own-colour.js";
import { paraboloid } from "./parts/paraboloid.js";
import { splats } from "./parts/splats.js";
import { tone } from "./parts/tone.js";

/** All effects, in the order in which they stand in a program and in the ledger. */
export const EFFECTS: readonly Effect[] = [
  ...[ownColour, gradient, classification, levelOfDetail, blend, tone],
  ...[fixedSize, attenuatedSize, adaptiveSize],
  ...[disc, paraboloid, splats, eyeDomeLighting, opacity, dithering],
  ...[clip, highlight, filter],
];

import type { LedgerRow } from "../effects/index.js";
import { REFRACTION, type SightOptions, sightRise } from "../tools/plot/sight.js";

/** What a profile's ledger is made from. */
export interface ProfiledLine {
  /** Metres, as the profile counts them. */
  readonly length: number;
}

/**
 * What the plot of a profile could leave out, in the ledger's words: that heights follow the earth and sights do not.
 * @param tolerance metres from which it is told, such as what places are certified to
 */
export function profileLedger(
  { length }: ProfiledLine,
  tolerance: number,
  options: SightOptions = {},
): LedgerRow[] {
  const magnitude = sightRise(length, options);
  const active = magnitude >= tolerance;
  const { refraction = REFRACTION } = options;
  return [
    {
      effect: "curvatureAndRefraction",
      magnitude,
      unit: "m",
      threshold: tolerance,
      active,
      why: active
        ? "heights of a plot follow the earth: sights that are measured in it are drawn bent"
        : "over this length a sight is as straight as the plot",
      source: `rise of a level sight over the whole line, d² (1 − k) / 2R with k = ${refraction}`,
      cost: undefined,
    },
  ];
}

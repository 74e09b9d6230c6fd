import type { Crs } from "../crs/crs.js";
import type { Grid } from "../grid/window.js";
import { egm96Undulation } from "./egm96.js";
import { likelySystems, type VerticalSystem } from "./systems.js";

const DEGREE = Math.PI / 180;

/** What heights of unknown reference may be, and how much is at stake. */
export interface HeightGuess {
  /** Metres from the ellipsoid up to EGM96: by so much too low a height above sea level is drawn as it is. */
  readonly undulation: number;
  /** Height systems in use at the place, the likeliest first. */
  readonly systems: readonly VerticalSystem[];
  /** The same in words. */
  readonly note: string;
}

/**
 * What the heights of a data set may be, at its middle.
 *
 * @param systems table of vertical systems
 * @param longitude radians, as `latitude`
 * @param countries that the horizontal system is meant for, where they are known
 */
export function guessHeight(
  egm96: Grid,
  systems: readonly VerticalSystem[],
  { code, verticalUnit }: Pick<Crs, "code" | "verticalUnit">,
  longitude: number,
  latitude: number,
  countries?: readonly string[],
): HeightGuess {
  const undulation = egm96Undulation(egm96, longitude, latitude);
  const likely = likelySystems(systems, {
    longitude: longitude / DEGREE,
    latitude: latitude / DEGREE,
    horizontal: Number(/^EPSG:(\d+)/.exec(code ?? "")?.[1] ?? Number.NaN),
    unit: Math.abs(verticalUnit.size),
    countries,
  });
  const [first] = likely;
  const such = first ? `, such as ${first.name} (EPSG:${first.code})` : "";
  const way = `${Math.abs(undulation).toFixed(1)} m ${undulation < 0 ? "lower" : "higher"}`;
  const note = `shown as ellipsoidal; if the heights are above sea level${such}, the points should be ${way}`;
  return { undulation, systems: likely, note };
}

import {
  areaToDatum,
  distanceInPlot,
  type PlotPlace,
  sightBetween,
  sightClearance,
  sightRise,
  type TerrainStation,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { fixed } from "../language/numbers.js";

/** Metres from which it is told that sights are bent; a millimetre is what places of points are certified to. */
export const TOLERANCE = 0.001;

/** Corners that a bent sight is drawn with. */
const CORNERS = 48;

/** The line of sight between two places, as the plot shows it; none where it is as good as straight. */
export function sightIn(places: readonly PlotPlace[]): readonly PlotPlace[] {
  const [a, b] = places;
  if (!a || !b || sightRise(b[0] - a[0]) < TOLERANCE) return [];
  const height = sightBetween(a, b);
  return Array.from({ length: CORNERS + 1 }, (_, corner) => {
    const chainage = a[0] + ((b[0] - a[0]) * corner) / CORNERS;
    return [chainage, height(chainage)] as const;
  });
}

/**
 * Length, rise and slope between two places; then what a level sight between them rises, where it matters, how the sight clears the ground,
 * and the areas between the ground and the height of the first. One sentence each; none without two places.
 */
export function measuredWords([a, b]: readonly PlotPlace[], ground: readonly TerrainStation[]): string[] {
  if (!a || !b) return [];
  return [distanceWords(a, b), ...sightWords(a, b, ground), ...areaWords(a, b, ground)];
}

function distanceWords(a: PlotPlace, b: PlotPlace): string {
  const { along, up, slant, grade, angle } = distanceInPlot(a, b);
  const lengths = i18n.t("along {along} m, up {up} m, slant {slant} m", {
    along: fixed(along, 3),
    up: fixed(up, 3),
    slant: fixed(slant, 3),
  });
  const percent = Number.isFinite(grade) ? [`${fixed(100 * grade, 2)} %`] : [];
  return [lengths, ...percent, `${fixed((180 * angle) / Math.PI, 2)}°`].join(", ");
}

function sightWords(a: PlotPlace, b: PlotPlace, ground: readonly TerrainStation[]): string[] {
  const rise = sightRise(b[0] - a[0]);
  const rises =
    rise >= TOLERANCE
      ? [i18n.t("a level sight rises {rise} m (curvature and refraction)", { rise: fixed(rise, 3) })]
      : [];
  const least = sightClearance(ground, a, b);
  if (!least) return rises;
  const values = { metres: fixed(Math.abs(least.clearance), 2), chainage: fixed(least.chainage, 1) };
  return [
    ...rises,
    least.clearance < 0
      ? i18n.t("the ground stands in the sight by {metres} m at chainage {chainage} m", values)
      : i18n.t("the ground lies below the sight by at least {metres} m at chainage {chainage} m", values),
  ];
}

function areaWords(a: PlotPlace, b: PlotPlace, ground: readonly TerrainStation[]): string[] {
  const { above, below, length } = areaToDatum(ground, a[1], a[0], b[0]);
  if (!(length > 0)) return [];
  return [
    i18n.t("ground above the first place {above} m², below {below} m²", {
      above: fixed(above, 2),
      below: fixed(below, 2),
    }),
  ];
}

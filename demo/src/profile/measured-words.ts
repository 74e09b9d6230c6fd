import {
  areaToDatum,
  distanceInPlot,
  type PlotPlace,
  sightBetween,
  sightClearance,
  sightRise,
  type TerrainStation,
} from "@groma/layer/tools";

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
 * and the areas between the ground and the height of the first.
 */
export function measuredWords([a, b]: readonly PlotPlace[], ground: readonly TerrainStation[]): string {
  if (!a || !b) return "";
  const { along, up, slant, grade, angle } = distanceInPlot(a, b);
  const slope = Number.isFinite(grade) ? `${(100 * grade).toFixed(2)} %, ` : "";
  const parts = [
    `along ${along.toFixed(3)} m, up ${up.toFixed(3)} m, slant ${slant.toFixed(3)} m, ${slope}${((180 * angle) / Math.PI).toFixed(2)}°`,
  ];
  const rise = sightRise(along);
  if (rise >= TOLERANCE) parts.push(`a level sight rises ${rise.toFixed(3)} m (curvature and refraction)`);
  const least = sightClearance(ground, a, b);
  if (least) {
    const clears = least.clearance < 0 ? "stands in the sight by" : "lies below the sight by at least";
    parts.push(
      `the ground ${clears} ${Math.abs(least.clearance).toFixed(2)} m at chainage ${least.chainage.toFixed(1)} m`,
    );
  }
  const { above, below, length } = areaToDatum(ground, a[1], a[0], b[0]);
  if (length > 0) {
    parts.push(`ground above the first place ${above.toFixed(2)} m², below ${below.toFixed(2)} m²`);
  }
  return parts.join("; ");
}

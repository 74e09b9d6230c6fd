import type { PointCloud } from "@groma/layer/cesium";
import {
  type PlottedPoint,
  type Profile,
  type ProfilePoints,
  type StationEquations,
  stationText,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { fixed } from "../language/numbers.js";

/** What is told of a profile: its length and the points that were read so far. */
export function profileWords({ length }: Profile, count: number): string {
  return i18n.t("{length} m, {count, plural, one {# point} other {# points}}", {
    length: fixed(length, 1),
    count,
  });
}

/** What stands at the axes of the plot. */
export function axisWords(cloud: PointCloud | undefined): { readonly along: string; readonly up: string } {
  const height = cloud?.crs.height;
  const geoid = height?.kind === "geoid" ? `, ${height.model}` : "";
  const ellipsoid = height?.kind === "ellipsoidal" ? `, ${i18n.t("above the ellipsoid")}` : "";
  return {
    along: i18n.t("chainage (m)"),
    up: i18n.t("height (m{reference})", { reference: geoid + ellipsoid }),
  };
}

/** What is told of a point of the plot. @param stations of its line, where they are counted anew somewhere */
export function pointWords(
  { points, index }: PlottedPoint<ProfilePoints>,
  stations: StationEquations | undefined,
): string {
  const chainage = points.chainage[index]!;
  const words = i18n.t("chainage {chainage} m, height {height} m, offset {offset} m", {
    chainage: fixed(chainage, 2),
    height: fixed(points.height[index]!, 3),
    offset: fixed(points.offset[index]!, 2),
  });
  if (!stations) return words;
  const station = stationText(stations.stationOf(chainage).station);
  return `${words}, ${i18n.t("station {station}", { station })}`;
}

/** Where a point of the plot is: ECEF, metres. */
export function pointPlace(
  { origin }: Profile,
  { points, index }: PlottedPoint<ProfilePoints>,
): ArrayLike<number> {
  const { xyz } = points.batch.records;
  const at = 3 * points.batch.inside[index]!;
  const [x, y, z] = [0, 1, 2].map((axis) => xyz[at + axis]! * origin.scale[axis]! + origin.offset[axis]!);
  return origin.place(x!, y!, z!, new Float64Array(3));
}

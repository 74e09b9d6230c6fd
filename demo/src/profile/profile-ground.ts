import { Pace } from "@groma/layer/query";
import {
  type Profile,
  type ProfilePoints,
  TerrainLine,
  type TerrainStation,
  type TerrainStatistic,
} from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";

/** How the ground of a profile is found. */
export interface GroundChoice {
  readonly statistic: TerrainStatistic;
  /** Class of its points; undefined: all. */
  readonly classification: number | undefined;
}

/** Stations of a profile at most; few enough for a table. */
const MOST = 1000;

/** Lengths between stations, metres. */
const INTERVALS = [0.1, 0.2, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

/** The round interval at which a line has no more stations than a table can hold. @param length metres */
export function intervalFor(length: number): number {
  return INTERVALS.find((interval) => length / interval <= MOST) ?? length / MOST;
}

/**
 * The ground of a profile, from the points that are in the picture: worked out in stretches, so that the page stays alive.
 * @param parts points, node by node
 * @throws the signal's reason when aborted
 */
export async function groundOf(
  profile: Profile,
  parts: readonly ProfilePoints[],
  { statistic, classification }: GroundChoice,
  signal: AbortSignal,
): Promise<TerrainStation[]> {
  const from = profile.from;
  const line = new TerrainLine(from, from + profile.length, {
    ...{ interval: intervalFor(profile.length), statistic },
  });
  const pace = new Pace(signal);
  for (const { batch, chainage, height } of parts) {
    const classes = batch.records.attributes.find(({ name }) => name === "classification");
    if (classification !== undefined && !classes) continue;
    for (let index = 0; index < chainage.length; index++) {
      if (index % 4096 === 0) await pace.rest();
      const record = batch.inside[index]!;
      const wanted =
        classification === undefined ||
        classes!.bytes[classes!.at + record * classes!.stride] === classification;
      if (wanted) line.add(chainage[index]!, height[index]!);
    }
  }
  const stations: TerrainStation[] = [];
  for (const station of line.eachStation()) {
    stations.push(station);
    await pace.rest();
  }
  return stations;
}

const STATISTICS: ReadonlyMap<TerrainStatistic, string> = new Map<TerrainStatistic, string>([
  ["min", i18n.t("least")],
  ["mean", i18n.t("mean")],
  ["max", i18n.t("greatest")],
  [50, i18n.t("median")],
]);

/** What of the points of a station is its ground. */
export function statisticWords(statistic: TerrainStatistic): string {
  return STATISTICS.get(statistic) ?? i18n.t("percentile {number}", { number: String(statistic) });
}

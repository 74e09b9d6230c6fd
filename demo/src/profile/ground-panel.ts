import type { PointCloud } from "@groma/layer/cesium";
import type { Profile, TerrainStation, TerrainStatistic } from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { byId, setText } from "../panel/elements.js";
import { ClearanceWords } from "./clearance.js";
import type { Comparison } from "./comparison.js";
import { groundTable } from "./ground-table.js";
import type { ProfilePlot } from "./plot.js";
import type { ExportedProfile } from "./profile-export.js";
import { type GroundChoice, groundOf, intervalFor, statisticWords } from "./profile-ground.js";

/** Percentile that the table has where no statistic is chosen. */
const MEDIAN = 50;

/** The ground along a profile: its line in the picture, its table, and what stands clear above it. */
export class GroundPanel {
  readonly #by = byId("profile-ground", HTMLSelectElement);
  readonly #class = byId("profile-ground-class", HTMLInputElement);
  readonly #words = byId("profile-ground-words", HTMLElement);
  readonly #tableShown = byId("profile-table-shown", HTMLInputElement);
  readonly #table = byId("profile-table", HTMLElement);
  readonly #clearance: ClearanceWords;
  readonly #failed: (thrown: unknown) => void;
  #work: AbortController | undefined;
  #stations: TerrainStation[] = [];

  /**
   * @param changed hears that the reader asks for another ground
   * @param failed hears what kept it from being worked out
   */
  constructor(changed: () => void, failed: (thrown: unknown) => void) {
    this.#failed = failed;
    this.#clearance = new ClearanceWords(changed);
    for (const field of [this.#by, this.#class, this.#tableShown]) field.addEventListener("change", changed);
  }

  /** Its stations, as far as they are worked out. */
  get stations(): readonly TerrainStation[] {
    return this.#stations;
  }

  /** What files have of it; undefined: nothing, since the picture has none. */
  exported(profile: Profile): ExportedProfile["ground"] {
    if (!this.#drawn) return undefined;
    const { statistic, classification } = this.#choice();
    const classes = classification === undefined ? undefined : new Set([classification]);
    return { interval: intervalFor(profile.length) / profile.unit, statistic, classes };
  }

  /** Has no stations any more. */
  clear(): void {
    this.#stations = [];
    this.#table.replaceChildren();
  }

  /** Works it out for what the picture shows, and tells of it there and in words; where there is no profile, no more. */
  async tell(
    profile: Profile | undefined,
    plot: ProfilePlot | undefined,
    comparison: Comparison,
  ): Promise<void> {
    this.#work?.abort();
    if (!profile || !plot) return;
    this.#work = new AbortController();
    const { signal } = this.#work;
    const drawn = this.#drawn;
    const wanted = drawn || this.#tableShown.checked || comparison.active;
    const { statistic: chosen, classification } = this.#choice();
    const statistic = drawn ? chosen : MEDIAN;
    const choice = { statistic, classification };
    try {
      const found = await groundOf(profile, wanted ? plot.parts : [], choice, signal);
      this.#stations = found;
      this.#tellMissing(classification, plot);
      plot.ground = !drawn && !comparison.active ? [] : found;
      const second = await groundOf(profile, comparison.parts, choice, signal);
      plot.secondGround = comparison.active ? second : [];
      comparison.tell(found, second, profile.origin as PointCloud);
      this.#showTable(statistic);
      await this.#clearance.tell(profile, plot.parts, classification, signal);
    } catch (thrown) {
      if (!signal.aborted) this.#failed(thrown);
    }
  }

  /** Whether the picture has its line. */
  get #drawn(): boolean {
    return this.#by.value !== "";
  }

  #choice(): GroundChoice {
    const by = this.#by.value;
    const code = this.#class.valueAsNumber;
    const statistic = by.startsWith("p") ? Number(by.slice(1)) : (by as TerrainStatistic);
    return { statistic, classification: Number.isInteger(code) ? code : undefined };
  }

  /** Tells where there is no ground for want of points of the class that was asked for. */
  #tellMissing(classification: number | undefined, { count }: ProfilePlot): void {
    const points = this.#stations.reduce((sum, station) => sum + station.count, 0);
    const missing = classification !== undefined && this.#stations.length > 0 && count > 0 && points === 0;
    const words = missing
      ? i18n.t("No point along the line is of class {number}: there is no ground.", {
          number: classification,
        })
      : "";
    setText(this.#words, words);
  }

  #showTable(statistic: TerrainStatistic): void {
    this.#table.hidden = !this.#tableShown.checked;
    if (this.#table.hidden) return;
    const which = statisticWords(statistic);
    this.#table.replaceChildren(
      groundTable(this.#stations, i18n.t("Ground, {which} of each station, metres", { which })),
    );
  }
}

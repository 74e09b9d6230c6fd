import { leastClearance, type Profile, type ProfilePoints } from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";
import { fixed } from "../language/numbers.js";
import { byId, setText } from "../panel/elements.js";
import { groundOf } from "./profile-ground.js";

/** The least clearance of one class over another along a profile: of wires over ground, of a bridge over a road. */
export class ClearanceWords {
  readonly #above = byId("profile-clearance", HTMLInputElement);
  readonly #words = byId("profile-clearance-words", HTMLElement);

  /** @param changed hears of another class */
  constructor(changed: () => void) {
    this.#above.addEventListener("change", changed);
  }

  /**
   * Tells it, where a class is asked for.
   * @param below class that it is counted from; undefined: none was given
   * @throws the signal's reason when aborted
   */
  async tell(
    profile: Profile,
    parts: readonly ProfilePoints[],
    below: number | undefined,
    signal: AbortSignal,
  ): Promise<void> {
    const above = this.#above.valueAsNumber;
    if (!Number.isInteger(above) || below === undefined) {
      const missing = Number.isInteger(above)
        ? i18n.t("Give the class of the ground too: it is counted from there.")
        : "";
      setText(this.#words, missing);
      return;
    }
    const [ground, upper] = [
      await groundOf(profile, parts, { statistic: "max", classification: below }, signal),
      await groundOf(profile, parts, { statistic: "min", classification: above }, signal),
    ];
    const found = leastClearance(ground, upper);
    const words = found
      ? i18n.t(
          "Least clearance of class {above} over class {below}: {clearance} m at chainage {chainage} m",
          {
            above,
            below,
            clearance: fixed(found.clearance, 3),
            chainage: fixed(found.chainage, 1),
          },
        )
      : i18n.t("No station has points of class {above} over class {below}", { above, below });
    setText(this.#words, words);
  }
}

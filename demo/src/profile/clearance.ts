import { leastClearance, type Profile, type ProfilePoints } from "@groma/layer/tools";
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
        ? "Give the class of the ground too: it is counted from there."
        : "";
      setText(this.#words, missing);
      return;
    }
    const [ground, upper] = [
      await groundOf(profile, parts, { statistic: "max", classification: below }, signal),
      await groundOf(profile, parts, { statistic: "min", classification: above }, signal),
    ];
    const found = leastClearance(ground, upper);
    const which = `class ${above} over class ${below}`;
    const words = found
      ? `Least clearance of ${which}: ${found.clearance.toFixed(3)} m at chainage ${found.chainage.toFixed(1)} m`
      : `No station has points of ${which}`;
    setText(this.#words, words);
  }
}

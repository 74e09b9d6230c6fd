import { clipTexture, type NodeClips } from "../clips/index.js";
import type { DrawnNode } from "./drawn-node.js";
import type { Look } from "./look.js";

/** The records of the volumes of all drawn nodes in a look's texture. */
export class ClipRecords {
  /** What the texture holds, and where. */
  #shown: readonly NodeClips[] = [];
  #records: readonly (readonly [number, number])[] = [];
  #look: Look | undefined;

  /**
   * Lays the records of the drawn nodes into a look's texture, where an effect reads it.
   * @returns first texel and number of records of each node
   */
  show(look: Look, drawn: readonly DrawnNode[]): readonly (readonly [number, number])[] {
    const { active } = look.plan;
    if (!active.has("clip") && !active.has("highlight")) return [];
    const shown = drawn.map(({ clips }) => clips);
    const same = shown.length === this.#shown.length && shown.every((clips, at) => clips === this.#shown[at]);
    if (same && look === this.#look) return this.#records;
    const { data, width, height, records } = clipTexture(shown);
    look.setTexture("u_clips", width, height, data);
    this.#shown = shown;
    this.#records = records;
    this.#look = look;
    return records;
  }
}

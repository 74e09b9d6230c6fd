import type { BoxRelation, QueryVolume } from "../../query/index.js";
import { Corridor } from "../profile/corridor.js";
import { Strip } from "../profile/strip.js";

/** A cross-section of a line. */
export interface CrossSection {
  /** Chainage on the line. */
  readonly station: number;
  /** Where that is: x and y, source units. */
  readonly centre: readonly [number, number];
  /**
   * The strip across, from its left end to its right one, as seen along the line. Chainages in it are distances from the
   * line, right positive; offsets are positive ahead of the station.
   */
  readonly strip: Corridor;
}

/** How far cross-sections reach, source units. */
export interface SectionWidths {
  readonly left: number;
  readonly right: number;
  /** Of the strip whose points belong to the section, half of it before the station and half behind. */
  readonly thickness: number;
}

/**
 * Cross-sections at right angles to a line, all cut in one pass over a data set. A point belongs to each section in whose
 * rectangle it lies, its edges included, decided without any rounding: to several where sections overlap, as they do on
 * the inner side of bends.
 */
export class CrossSections implements QueryVolume {
  readonly sections: readonly CrossSection[];
  readonly #strip: Strip;

  /**
   * @param line whose chainages the stations are
   * @param chainages of the sections, on the line
   * @throws RangeError where there is no station, one lies beyond the line, or a width is none
   */
  constructor(line: Corridor, chainages: readonly number[], { left, right, thickness }: SectionWidths) {
    if (!(left >= 0 && right >= 0 && left + right > 0 && Number.isFinite(left + right)))
      throw new RangeError(`sections cannot reach ${left} to the left and ${right} to the right`);
    if (!(thickness > 0 && Number.isFinite(thickness)))
      throw new RangeError(`the thickness of sections cannot be ${thickness}`);
    if (chainages.length === 0) throw new RangeError("no station is given");
    this.sections = chainages.map((station) => {
      const place = line.at(station);
      if (!place) throw new RangeError(`the line has no chainage ${station}`);
      const { x, y, direction } = place;
      const [dx, dy] = direction;
      const ends = [
        [x - left * dy, y + left * dx],
        [x + right * dy, y - right * dx],
      ] as const;
      const lengths = [left + right];
      return { station, centre: [x, y], strip: new Corridor(ends, thickness, { lengths, start: -left }) };
    });
    const ends = this.sections.flatMap(({ strip }) => strip.vertices.flat());
    this.#strip = new Strip(Float64Array.from(ends), thickness / 2, false);
  }

  /** Number of sections. */
  get count(): number {
    return this.sections.length;
  }

  toBox(box: Float64Array): BoxRelation {
    return this.#strip.toBox(box);
  }

  contains(x: number, y: number): boolean {
    return this.#strip.contains(x, y);
  }

  /**
   * The sections that a point lies in.
   * @param out receives their numbers, rising; as long as {@link count}
   * @returns how many they are
   */
  partsAt(x: number, y: number, _z: number, out: Uint32Array): number {
    const { members, begin, end } = this.#strip.near(x, y);
    let found = 0;
    for (let at = begin; at < end; at++) {
      if (this.#strip.isNear(members[at], x, y)) out[found++] = members[at];
    }
    return found;
  }
}

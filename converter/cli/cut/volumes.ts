import {
  BoxVolume,
  Corridor,
  CrossSections,
  PolygonVolume,
  type QueryVolume,
  type SectionWidths,
  SliceVolume,
  type Stationing,
  terrainStations,
} from "@groma/layer/tools";
import { OptionError } from "../given/option-error.js";
import type { InSource } from "./place.js";

type Positions = InSource["positions"];

/** Makes a volume of what was given. @throws OptionError with the code, where that is none */
function made<T>(make: () => T, code: string, file: string, fix: string): T {
  try {
    return make();
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    throw new OptionError({ code, file, cause: error.message, fix });
  }
}

/**
 * The strip along a line.
 * @param width in the unit of lengths that goes with the line
 * @throws OptionError OPTION_LINE where the line has no length
 */
export function corridor(
  { positions, unit }: InSource,
  width: number,
  stationing: Stationing,
  given: string,
): Corridor {
  const fix = "give a line with two or more different vertices";
  return made(() => new Corridor(positions, width * unit, stationing), "OPTION_LINE", given, fix);
}

/**
 * Cross-sections of a line.
 * @param chainages says where, given both ends of the line
 * @throws OptionError OPTION_SECTIONS where there is none, one lies beyond the line, or a width is none
 */
export function crossSections(
  line: Corridor,
  chainages: (from: number, to: number) => readonly number[],
  widths: SectionWidths,
): CrossSections {
  const { chainages: own } = line;
  const make = () => new CrossSections(line, chainages(own[0]!, own[own.length - 1]!), widths);
  return made(make, "OPTION_SECTIONS", "--sections", "give --interval, or --at with chainages of the line");
}

/**
 * Sees to it that the ground along a line has stations, before anything is read.
 * @param interval undefined: no ground is asked for
 * @throws OptionError OPTION_GROUND where there are too many, or none
 */
export function checkGround({ chainages }: Corridor, interval: number | undefined): void {
  if (interval === undefined) return;
  const fix = "give a distance between stations that suits the length of the line";
  const count = () => terrainStations(chainages[0]!, chainages[chainages.length - 1]!, interval);
  made(count, "OPTION_GROUND", "--ground-interval", fix);
}

/** All that stands on a polygon. @throws OptionError OPTION_POLYGON where a ring has no area */
export function polygon(rings: readonly Positions[], given: string): PolygonVolume {
  return made(() => new PolygonVolume(rings), "OPTION_POLYGON", given, "give rings of three or more corners");
}

/**
 * An upright box, `minX,minY,maxX,maxY` or `minX,minY,minZ,maxX,maxY,maxZ`.
 * @throws OptionError OPTION_BOX where it is none
 */
export function box(numbers: readonly number[]): BoxVolume {
  const half = numbers.length / 2;
  const corner = (from: number, open: number) =>
    [numbers[from]!, numbers[from + 1]!, half === 3 ? numbers[from + 2]! : open] as const;
  const [min, max] = [corner(0, Number.NEGATIVE_INFINITY), corner(half, Number.POSITIVE_INFINITY)];
  const fix = "give the least coordinates, then the greatest";
  return made(() => new BoxVolume(min, max), "OPTION_BOX", "--box", fix);
}

/** All between two heights, of another volume or of everything. @throws OptionError OPTION_HEIGHTS */
export function slice([low, high]: readonly number[], of: QueryVolume | undefined): SliceVolume {
  const fix = "give the lower height first";
  return made(() => new SliceVolume(low!, high!, of), "OPTION_HEIGHTS", "--heights", fix);
}

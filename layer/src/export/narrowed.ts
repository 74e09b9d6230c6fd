import { type Clip, ClipSet, type SourceSpace } from "../clips/index.js";
import { checkFilter, type PointFilter } from "../effects/index.js";
import { Pace, type QueryVolume } from "../query/index.js";
import { ClippedVolume } from "../tools/area/clipped-volume.js";
import { type KnownPoints, knownOf } from "./known.js";
import { noPlace } from "./passing.js";
import type { PartedVolume, PointSelection } from "./selection.js";

/** What is left of points. */
export interface Narrowing {
  /** Volumes that cut, such as `layer.clips`; what only highlights changes nothing. Default: none. */
  readonly clips?: Iterable<Clip> | undefined;
  /** What passes, such as `layer.filter`. Default: everything. */
  readonly filter?: PointFilter | undefined;
}

/**
 * The points of a selection that clips and a filter leave, decided on their exact values and places; the same in a page and
 * on a command line.
 * @param known Default: what the selection's origin tells
 * @throws StyleError STYLE_FILTER, STYLE_CLIP; RangeError where a polygon in source coordinates has no area
 * @throws FormatError EXPORT_NO_PLACE where volumes are asked for and the points' place is not known; PlacementError; the
 *   signal's reason when aborted
 */
export async function narrowed<S extends PointSelection>(
  selection: S,
  { clips, filter }: Narrowing,
  known: KnownPoints = knownOf(selection.origin),
  signal?: AbortSignal,
): Promise<S> {
  const { name } = selection.origin;
  const { attributes, space } = known;
  if (filter && attributes) checkFilter(filter, { name, attributes });
  const volumes = [...new ClipSet(clips ?? [])];
  if (volumes.length > 0 && !space) throw noPlace(name, "clips of the globe");
  const { volume: of } = selection;
  const left = space && volumes.length > 0 ? await clipped(volumes, space, of, signal) : of;
  const volume = left && left !== of && isParted(of) ? inParts(of, left) : left;
  // What a class has as a getter is not copied with the rest.
  return { ...selection, along: selection.along, volume, filter: filter ?? selection.filter };
}

function isParted(volume: QueryVolume | undefined): volume is PartedVolume {
  return volume !== undefined && "partsAt" in volume;
}

/** What is left of a volume of parts, cross-sections say: in the same parts. */
function inParts<V extends PartedVolume>(parts: V, left: QueryVolume): PartedVolume {
  const places = "sections" in parts ? { sections: parts.sections } : {};
  return {
    ...places,
    count: parts.count,
    toBox: (box) => left.toBox(box),
    contains: (x, y, z) => left.contains(x, y, z),
    partsAt: (x, y, z, out) => parts.partsAt(x, y, z, out),
  };
}

async function clipped(
  clips: readonly Clip[],
  space: SourceSpace,
  of: QueryVolume | undefined,
  signal: AbortSignal | undefined,
): Promise<QueryVolume> {
  const steps = ClippedVolume.overInSteps(clips, space, of);
  const pace = new Pace(signal);
  for (;;) {
    const { done, value } = steps.next();
    if (done) return value;
    await pace.rest();
  }
}

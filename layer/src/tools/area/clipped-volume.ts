import {
  type Clip,
  compileClip,
  extendedPlace,
  finish,
  type SourceSpace,
  type Steps,
  type Volume,
} from "../../clips/index.js";
import type { BoxRelation, QueryVolume } from "../../query/index.js";
import { PolygonVolume } from "./polygon-volume.js";
import { SliceVolume } from "./slice-volume.js";

interface Cut {
  readonly mode: "inside" | "outside";
  readonly volume: QueryVolume;
}

/**
 * What clips leave of a data set, as a volume of its source coordinates: what is inside one of those that keep (if there are
 * any) and in none that cuts; those that only highlight change nothing.
 *
 * Polygons in source coordinates are decided without rounding, edges included, as {@link PolygonVolume} does; all others in
 * float64 at the exact place of a point, as picks are.
 */
export class ClippedVolume implements QueryVolume {
  readonly #cuts: readonly Cut[];
  readonly #keeps: boolean;
  readonly #of: QueryVolume | undefined;

  private constructor(cuts: readonly Cut[], of: QueryVolume | undefined) {
    this.#cuts = cuts;
    this.#keeps = cuts.some(({ mode }) => mode === "inside");
    this.#of = of;
  }

  /**
   * @param clips volumes, a `ClipSet` for example
   * @param space the data set; a `PointCloud` is one
   * @param of the volume that is clipped. Default: everything
   * @throws StyleError STYLE_CLIP; PlacementError where a clip in source coordinates has no place
   * @throws RangeError where a polygon in source coordinates has no area
   */
  static over(clips: Iterable<Clip>, space: SourceSpace, of?: QueryVolume): ClippedVolume {
    return finish(ClippedVolume.overInSteps(clips, space, of));
  }

  /** The same in steps, for polygons of many corners. @internal */
  static *overInSteps(clips: Iterable<Clip>, space: SourceSpace, of?: QueryVolume): Steps<ClippedVolume> {
    const places = new Places(space);
    const cuts: Cut[] = [];
    for (const clip of clips) {
      const { mode } = clip;
      if (mode === "highlight") continue;
      const own = clip.kind === "polygon" && clip.coordinates === "source";
      const volume = own ? standing(clip) : new PlacedVolume(yield* compileClip(clip, space), places);
      cuts.push({ mode, volume });
    }
    return new ClippedVolume(cuts, of);
  }

  toBox(box: Float64Array): BoxRelation {
    const whole = this.#of?.toBox(box) ?? "in";
    if (whole === "out") return "out";
    let kept: BoxRelation = this.#keeps ? "out" : "in";
    let crossed = whole === "crossing";
    for (const { mode, volume } of this.#cuts) {
      if (mode === "inside" && kept === "in") continue;
      const relation = volume.toBox(box);
      if (mode === "inside") kept = relation === "out" ? kept : relation;
      else if (relation === "in") return "out";
      else crossed ||= relation === "crossing";
    }
    return kept === "in" && crossed ? "crossing" : kept;
  }

  contains(x: number, y: number, z: number): boolean {
    let kept = !this.#keeps;
    for (const { mode, volume } of this.#cuts) {
      if ((mode === "inside" && kept) || !volume.contains(x, y, z)) continue;
      if (mode === "outside") return false;
      kept = true;
    }
    return kept && (this.#of?.contains(x, y, z) ?? true);
  }
}

/** A polygon of source coordinates between its heights. */
function standing({ ring, bottom, top }: Extract<Clip, { kind: "polygon" }>): QueryVolume {
  const polygon = new PolygonVolume([ring]);
  if (bottom === undefined && top === undefined) return polygon;
  return new SliceVolume(bottom ?? Number.NEGATIVE_INFINITY, top ?? Number.POSITIVE_INFINITY, polygon);
}

/** Where source coordinates lie, worked out once for all volumes that are asked about the same point or box. */
class Places {
  readonly #place: ReturnType<typeof extendedPlace>;
  readonly #source = new Float64Array(3).fill(Number.NaN);
  readonly #ecef = new Float64Array(3);
  /** Places of a lattice over a box: its corners, and the middles between them. */
  readonly #lattice = new Float64Array(3 * 27);

  constructor(space: SourceSpace) {
    this.#place = extendedPlace(space);
  }

  /** ECEF, metres; overwritten by the next call. */
  of(x: number, y: number, z: number): Float64Array {
    const [px, py, pz] = this.#source;
    if (px !== x || py !== y || pz !== z) {
      this.#place(x, y, z, this.#ecef);
      this.#source.set([x, y, z]);
    }
    return this.#ecef;
  }

  /**
   * Radius of a sphere about the middle of a box that all of the box lies in, metres: as far as the farthest place of the
   * lattice, and a multiple of how far the box is bent between two of them. Infinite or not a number where it has no place.
   * @param middle receives the place of the middle
   */
  radius(box: Float64Array, middle: Float64Array): number {
    const lattice = this.#lattice;
    const at = (axis: number, step: number) => box[axis] + ((box[axis + 3] - box[axis]) * step) / 2;
    for (let index = 0; index < 27; index++) {
      const place = lattice.subarray(3 * index, 3 * index + 3);
      this.#place(at(0, index % 3), at(1, Math.floor(index / 3) % 3), at(2, Math.floor(index / 9)), place);
    }
    middle.set(lattice.subarray(3 * 13, 3 * 14));
    let [reach, bend] = [0, 0];
    for (let index = 0; index < 27; index++) {
      const apart = [0, 1, 2].map((axis) => lattice[3 * index + axis] - middle[axis]);
      reach = Math.max(reach, Math.hypot(...apart));
      for (const step of [1, 3, 9]) {
        if (Math.floor(index / step) % 3 !== 1) continue;
        const away = [0, 1, 2].map((axis) => {
          const sides = lattice[3 * (index - step) + axis] + lattice[3 * (index + step) + axis];
          return lattice[3 * index + axis] - sides / 2;
        });
        bend = Math.max(bend, Math.hypot(...away));
      }
    }
    return reach + 4 * bend + 1e-6;
  }
}

/** A volume of the globe, asked about source coordinates. */
class PlacedVolume implements QueryVolume {
  readonly #volume: Volume;
  readonly #places: Places;
  readonly #source = new Float64Array(3);
  readonly #middle = new Float64Array(3);

  constructor(volume: Volume, places: Places) {
    this.#volume = volume;
    this.#places = places;
  }

  toBox(box: Float64Array): BoxRelation {
    const radius = this.#places.radius(box, this.#middle);
    if (!Number.isFinite(radius)) return "crossing";
    const [x, y, z] = this.#middle;
    return this.#volume.toSphere(x, y, z, radius);
  }

  contains(x: number, y: number, z: number): boolean {
    const source = this.#source;
    source[0] = x;
    source[1] = y;
    source[2] = z;
    return this.#volume.contains(this.#places.of(x, y, z), source);
  }
}

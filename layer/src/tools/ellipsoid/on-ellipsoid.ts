import type { LocalPlane } from "@groma/georef";
import type { BoxRelation, QueryVolume } from "../../query/index.js";
import type { Corridor } from "../profile/corridor.js";
import type { CrossSections } from "../sections/cross-sections.js";

/** Where source coordinates are: longitude and latitude, WGS 84, radians, written to `out`. */
export type Geodetic = (x: number, y: number, z: number, out: Float64Array) => void;

/** Least and greatest source coordinates of a data set. */
export interface SourceBounds {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** What the wrapped volumes have in common. */
export type InPlane = Pick<QueryVolume, "toBox"> & { contains(x: number, y: number): boolean };

/**
 * A volume in a plane of the ellipsoid, for data sets whose own coordinates are angles, or which lie in different systems:
 * points are brought into that plane, one by one, and decided there.
 */
export abstract class OnEllipsoid<T extends InPlane> implements QueryVolume {
  protected readonly inner: T;
  readonly #plane: LocalPlane;
  readonly #geodetic: Geodetic;
  readonly #bounds: SourceBounds;
  protected readonly place = new Float64Array(3);

  /** @param bounds of the data set, beyond which its coordinates need have no place */
  constructor(inner: T, plane: LocalPlane, geodetic: Geodetic, bounds: SourceBounds) {
    this.#bounds = bounds;
    this.inner = inner;
    this.#plane = plane;
    this.#geodetic = geodetic;
  }

  /** Brings source coordinates into the plane: x and y in {@link place}. */
  protected bring(x: number, y: number, z: number): void {
    this.#geodetic(x, y, z, this.place);
    this.#plane.toPlane(this.place[0], this.place[1], this.place);
  }

  /** Where source coordinates are in the plane: x and y, metres, written to `out`. */
  toPlane(x: number, y: number, z: number, out: Float64Array): void {
    this.bring(x, y, z);
    out[0] = this.place[0];
    out[1] = this.place[1];
  }

  contains(x: number, y: number, z: number): boolean {
    this.bring(x, y, z);
    return this.inner.contains(this.place[0], this.place[1]);
  }

  /**
   * A box of source coordinates is bent in the plane: 27 of its places, on a lattice, say where it lies, and how far the
   * places between two of them lie from their middle bounds what bending adds.
   */
  toBox(whole: Float64Array): BoxRelation {
    const box = new Float64Array(6);
    for (const axis of [0, 1, 2]) {
      box[axis] = Math.max(whole[axis], this.#bounds.min[axis]);
      box[axis + 3] = Math.min(whole[axis + 3], this.#bounds.max[axis]);
      if (box[axis] > box[axis + 3]) return "crossing";
    }
    const lattice = new Float64Array(2 * 27);
    for (let at = 0; at < 27; at++) {
      const [i, j, k] = [at % 3, Math.floor(at / 3) % 3, Math.floor(at / 9)];
      const along = (axis: number, step: number) => box[axis] + ((box[axis + 3] - box[axis]) * step) / 2;
      this.bring(along(0, i), along(1, j), along(2, k));
      lattice[2 * at] = this.place[0];
      lattice[2 * at + 1] = this.place[1];
    }
    const out = Float64Array.of(Infinity, Infinity, box[2], -Infinity, -Infinity, box[5]);
    let bend = 0;
    for (let at = 0; at < 27; at++) {
      for (const axis of [0, 1]) {
        const value = lattice[2 * at + axis];
        if (!Number.isFinite(value)) return "crossing";
        out[axis] = Math.min(out[axis], value);
        out[axis + 3] = Math.max(out[axis + 3], value);
        for (const [step, digit] of STEPS) {
          if (Math.floor(at / digit) % 3 !== 1) continue;
          const middle = (lattice[2 * (at - step) + axis] + lattice[2 * (at + step) + axis]) / 2;
          bend = Math.max(bend, Math.abs(value - middle));
        }
      }
    }
    const slack = 4 * bend + 1e-6;
    for (const axis of [0, 1]) {
      out[axis] -= slack;
      out[axis + 3] += slack;
    }
    return this.inner.toBox(out);
  }
}

/** Steps of the lattice along its three axes, and the divisor that finds the digit of each. */
const STEPS = [
  [1, 1],
  [3, 3],
  [9, 9],
] as const;

/** A corridor in a plane of the ellipsoid; its chainages and offsets are metres there. */
export class CorridorOnEllipsoid extends OnEllipsoid<Corridor> {
  get vertices(): Corridor["vertices"] {
    return this.inner.vertices;
  }

  get chainages(): Corridor["chainages"] {
    return this.inner.chainages;
  }

  locate(x: number, y: number, out: Float64Array, z = 0): number {
    this.bring(x, y, z);
    return this.inner.locate(this.place[0], this.place[1], out);
  }
}

/** Cross-sections in a plane of the ellipsoid. */
export class CrossSectionsOnEllipsoid extends OnEllipsoid<CrossSections> {
  readonly sections: readonly {
    readonly station: number;
    readonly centre: readonly [number, number];
    readonly strip: CorridorOnEllipsoid;
  }[];

  constructor(inner: CrossSections, plane: LocalPlane, geodetic: Geodetic, bounds: SourceBounds) {
    super(inner, plane, geodetic, bounds);
    this.sections = inner.sections.map(({ strip, ...section }) => ({
      ...section,
      strip: new CorridorOnEllipsoid(strip, plane, geodetic, bounds),
    }));
  }

  get count(): number {
    return this.inner.count;
  }

  partsAt(x: number, y: number, z: number, out: Uint32Array): number {
    this.bring(x, y, z);
    return this.inner.partsAt(this.place[0], this.place[1], 0, out);
  }
}

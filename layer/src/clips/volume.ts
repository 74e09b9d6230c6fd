import type { Frame } from "@groma/georef";
import type { ROLES } from "./clip-roles.js";
import type { Steps } from "./steps.js";

/** What happens to the points inside a volume: only they stay, they are cut, or they stand out. */
export type ClipMode = keyof typeof ROLES;

/** How a volume lies to a node or a sphere: around it, apart from it, or through it (or it may be). */
export type Relation = "in" | "out" | "crossing";

/** A node as volumes see it. */
export interface ClipNode {
  readonly frame: Frame;
  /** Least and greatest position in the frame: min x, y, z, max x, y, z, metres. */
  readonly box: ArrayLike<number>;
}

/** A record for the shader: {@link CLIP_ROLES} without its role. */
export interface VolumeRecord {
  readonly kind: number;
  readonly count: number;
  readonly bits: number;
  /** Texels after the first. */
  readonly texels: readonly number[];
}

/** What clips in source coordinates must know of a data set; a `PointCloud` is one. */
export interface SourceSpace {
  /** Source coordinates → ECEF, metres. May throw outside {@link boundingBox}. */
  place(x: number, y: number, z: number, out: Float64Array): Float64Array;
  /** Source coordinates of all points. */
  readonly boundingBox: {
    readonly min: readonly [number, number, number];
    readonly max: readonly [number, number, number];
  };
}

/** Source coordinates → ECEF, metres, defined everywhere. */
export type Place = (x: number, y: number, z: number, out: Float64Array) => Float64Array;

/** A part of space, in float64. */
export interface Volume {
  /** Whether a point is inside, by its ECEF place, metres, and its source coordinates. */
  contains(ecef: ArrayLike<number>, source: ArrayLike<number>): boolean;
  /** How it lies to a sphere in ECEF, metres; `crossing` where that is not certain. */
  toSphere(x: number, y: number, z: number, radius: number): Relation;
  /** How it lies to a node; a record of what crosses it. */
  toNode(node: ClipNode): Steps<"in" | "out" | VolumeRecord>;
}

/** The same volume, which works out each node once: others may come and go beside it. */
export function remembering(volume: Volume): Volume {
  const known = new WeakMap<ClipNode, "in" | "out" | VolumeRecord>();
  return {
    ...volume,
    *toNode(node) {
      const found = known.get(node) ?? (yield* volume.toNode(node));
      known.set(node, found);
      return found;
    },
  };
}

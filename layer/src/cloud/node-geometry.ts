import {
  type Crs,
  ecefToGeodetic,
  PlacementError,
  type PointTransform,
  pointTransform,
  type Truth,
} from "@groma/georef";
import { ancestorAt, isWithin, keyName, type NodeBounds, ROOT_KEY, type VoxelKey } from "../octree/index.js";
import { nodeCube } from "../query/index.js";
import type { PointSource } from "../sources/contract/point-source.js";
import { type AffineMap, affineBounds, affineMap } from "./affine-bounds.js";

/** Radius from which the sag of the ground between samples is reckoned, metres: the least of the WGS84 ellipsoid's. */
const LEAST_RADIUS_OF_CURVATURE = 6_335_439;

/** Every so many levels nodes have maps that nodes below them may use. */
const LEVELS_PER_MAP = 2;

/** Maps that are kept at most, half a kilobyte each. */
const MAPS = 16_384;

/** What the geometry is made from. */
export type GeometrySource = Pick<PointSource, "cube" | "boundingBox" | "spacing">;

/** Map of a node's part of the data, where there is one. */
interface NodeMap {
  readonly key: VoxelKey;
  readonly map: AffineMap | undefined;
}

/** Cubes of octree nodes: in source coordinates, and as spheres on the globe. */
export class NodeGeometry {
  #source: GeometrySource;
  readonly #transform: PointTransform;
  readonly #unit: number;
  readonly #maps = new Map<string, NodeMap>();
  /** The map that was last asked for at each depth: nodes come with their siblings. */
  readonly #last: (NodeMap | undefined)[] = [];
  /** The box of the node at hand. */
  readonly #box = new Float64Array(6);

  constructor(source: GeometrySource, truth: Truth, crs: Pick<Crs, "horizontalUnit">) {
    this.#source = source;
    this.#transform = pointTransform(truth);
    const { kind, size } = crs.horizontalUnit;
    this.#unit = kind === "angular" ? size * LEAST_RADIUS_OF_CURVATURE : size;
  }

  /** Replaces the bounding box. */
  widen(boundingBox: PointSource["boundingBox"]): void {
    this.#source = { cube: this.#source.cube, spacing: this.#source.spacing, boundingBox };
    this.#maps.clear();
    this.#last.length = 0;
  }

  /** Cube of a node in source coordinates: min x, y, z and edge. */
  cube(key: VoxelKey): [number, number, number, number] {
    return nodeCube(this.#source.cube, key);
  }

  /** Least and greatest height above WGS84 of the data set's bounding box, metres; zeros where it has no place. */
  get heights(): readonly [number, number] {
    const samples = this.#sample(this.#dataBox(ROOT_KEY, new Float64Array(6)));
    if (!samples.every(Number.isFinite)) return [0, 0];
    const heights: number[] = [];
    const geodetic = new Float64Array(3);
    for (let at = 0; at < samples.length; at += 3) {
      ecefToGeodetic(samples[at], samples[at + 1], samples[at + 2], geodetic);
      heights.push(geodetic[2]);
    }
    return [Math.min(...heights), Math.max(...heights)];
  }

  /**
   * Sphere around the part of a node's cube in which the data set has points, and the spacing of its points on the
   * ground; undefined where the data set's map has no such place. What the file's own transformation covers ends with
   * its bounding box, which cubes reach beyond.
   *
   * Sampling the map costs tens of microseconds, too much for thousands of nodes in a frame: small nodes get theirs
   * from the affine map of a node above, which says how far it is off.
   */
  bounds(key: VoxelKey): NodeBounds | undefined {
    const box = this.#dataBox(key, this.#box);
    const spacing = this.#spacing(key.depth);
    // The highest that is good enough serves the most nodes.
    for (let depth = 0; depth < key.depth; depth += LEVELS_PER_MAP) {
      const map = this.#mapAbove(key, depth);
      const bounds = map && affineBounds(map, box, spacing);
      if (bounds) return bounds;
    }
    return this.#sampledBounds(box, spacing);
  }

  /** Map of the node at a depth that a node lies in. */
  #mapAbove(key: VoxelKey, depth: number): AffineMap | undefined {
    const last = this.#last[depth];
    if (last && isWithin(key, last.key)) return last.map;
    const above = ancestorAt(key, depth);
    const name = keyName(above);
    let found = this.#maps.get(name);
    if (!found) {
      const box = this.#dataBox(above, new Float64Array(6));
      found = { key: above, map: affineMap(box, this.#sample(box), this.#unit) };
      // Begun anew rather than kept in order of use, which would cost as much as a node's bounds do.
      if (this.#maps.size === MAPS) this.#maps.clear();
      this.#maps.set(name, found);
    }
    this.#last[depth] = found;
    return found.map;
  }

  #sampledBounds(box: Float64Array, spacing: number): NodeBounds | undefined {
    const samples = this.#sample(box);
    if (!samples.every(Number.isFinite)) return undefined;
    const point = (i: number, j: number, high: number) => {
      const from = 6 * (3 * j + i) + 3 * high;
      return [samples[from], samples[from + 1], samples[from + 2]] as const;
    };
    const low = point(1, 1, 0);
    const top = point(1, 1, 1);
    const [x, y, z] = low.map((value, axis) => (value + top[axis]) / 2) as [number, number, number];
    let radius = 0;
    for (let from = 0; from < samples.length; from += 3) {
      radius = Math.max(radius, Math.hypot(samples[from] - x, samples[from + 1] - y, samples[from + 2] - z));
    }
    // Ground between the samples bulges out by the sagitta of its chord.
    radius += (2 * radius) ** 2 / (8 * LEAST_RADIUS_OF_CURVATURE);
    const scaleX = distance(point(0, 1, 0), point(2, 1, 0)) / (box[3] - box[0]);
    const scaleY = distance(point(1, 0, 0), point(1, 2, 0)) / (box[4] - box[1]);
    const metresPerUnit = Math.max(...[scaleX, scaleY].filter(Number.isFinite), 0) || this.#unit;
    return { x, y, z, radius, spacing: spacing * metresPerUnit };
  }

  /** Spacing at a depth, source units. */
  #spacing(depth: number): number {
    return this.#source.spacing / 2 ** depth;
  }

  /** Part of a node's cube inside the data set's bounding box; the cube where they do not meet: min x, y, z, max x, y, z. */
  #dataBox(key: VoxelKey, out: Float64Array): Float64Array {
    const { min, max } = this.#source.boundingBox;
    const [minX, minY, minZ, whole] = this.#source.cube;
    const edge = whole / 2 ** key.depth;
    out[0] = minX + key.x * edge;
    out[1] = minY + key.y * edge;
    out[2] = minZ + key.z * edge;
    let meet = true;
    for (let axis = 0; axis < 3; axis++) {
      out[axis + 3] = out[axis] + edge;
      meet &&= out[axis] <= max[axis] && out[axis + 3] >= min[axis];
    }
    for (let axis = 0; meet && axis < 3; axis++) {
      out[axis] = Math.max(out[axis], min[axis]);
      out[axis + 3] = Math.min(out[axis + 3], max[axis]);
    }
    return out;
  }

  /** ECEF of a grid of 3 × 3 over a box in plane, each at its lower and its upper side: 54 numbers. */
  #sample(box: Float64Array): Float64Array {
    const samples = new Float64Array(54);
    for (let j = 0; j < 3; j++) {
      for (let i = 0; i < 3; i++) {
        const x = box[0] + ((box[3] - box[0]) * i) / 2;
        const y = box[1] + ((box[4] - box[1]) * j) / 2;
        const to = 6 * (3 * j + i);
        this.#transform(x, y, box[2], samples, to);
        this.#transform(x, y, box[5], samples, to + 3);
      }
    }
    return samples;
  }
}

/**
 * Sphere around all points of a data set.
 * @param system the coordinate system that the page derived the places from; undefined: the file's own transformation
 * @throws PlacementError PLACE_DOMAIN where they have no place
 */
export function rootBounds(geometry: NodeGeometry, file: string, system: string | undefined): NodeBounds {
  const bounds = geometry.bounds(ROOT_KEY);
  if (bounds) return bounds;
  const derived = system !== undefined;
  const what = system ?? "the transformation in its georeference record";
  throw new PlacementError({
    code: "PLACE_DOMAIN",
    file,
    cause: `its coordinates lie outside what ${what} covers`,
    fix: derived
      ? "Check the coordinate system, or give the right one with the option crs"
      : "Convert the scan again, or give its coordinate system with the option crs",
  });
}

function distance(a: readonly number[], b: readonly number[]): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

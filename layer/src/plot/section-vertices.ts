import { ecefToGeodetic, type Frame } from "@groma/georef";
import type { PointCloud } from "../cloud/index.js";
import type { DrawnVertices } from "../drawing/drawn-vertices.js";
import { OFFSET } from "../effects/index.js";
import { type GeodeticPlace, recordNumbers } from "../query/index.js";
import type { ProfilePoints } from "../tools/cut/profile.js";
import { type Column, constantColumn, halfUlp32, recordedColumn } from "../workers/index.js";

/** The column that has the level of each point's node. */
export const LEVEL = "levelOfDetail";

/** What the points of a section are taken from, as far as their picture needs it. */
export type PlottedCloud = Pick<
  PointCloud,
  "name" | "attributes" | "scale" | "offset" | "place" | "bounds" | "appearance"
>;

/** Heights of a cloud's points above the ellipsoid, as its own map has them. */
export function geodeticOf(cloud: PlottedCloud): GeodeticPlace {
  return (x, y, z, out) => {
    cloud.place(x, y, z, out);
    ecefToGeodetic(out[0], out[1], out[2], out);
  };
}

/** Directions stay as they are. */
const LEVEL_ROTATION = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);

/** Points of a profile that heights above the ellipsoid are worked out of; those between go by their chainage. */
const KNOTS = 64;

/**
 * The points of a section from one node, as they are drawn: chainage, height and, so that the nearest to the line is seen,
 * their distance from it, metres. Attributes are made when a style first asks for them.
 */
export class SectionVertices implements DrawnVertices {
  readonly positions: Float32Array;
  readonly count: number;
  readonly order: Uint32Array;
  readonly frame: Frame;
  readonly box: Float32Array;
  readonly bound: number;
  readonly step = undefined;
  /** The plot has no cubes: nothing that reads them is drawn in it. */
  readonly toCube = new Float32Array(12);
  readonly onGlobe = undefined;
  readonly columns = { get: (name: string) => this.#column(name) };
  readonly #cloud: PlottedCloud;
  readonly #points: ProfilePoints;
  readonly #bits: () => 8 | 16;
  readonly #made = new Map<string, Column | undefined>();
  #madeBits: 8 | 16 | undefined;

  /** @param bits per colour channel that the scan uses, as far as that is known */
  constructor(cloud: PlottedCloud, points: ProfilePoints, bits: () => 8 | 16) {
    const { chainage, height, offset, batch } = points;
    const count = chainage.length;
    this.#cloud = cloud;
    this.#points = points;
    this.#bits = bits;
    this.count = count;
    this.order = batch.inside;
    // What is left of the numbers in the plot's frame is held by float32 to a micrometre in ten metres.
    const origin = Float64Array.of(Math.floor(chainage[0] ?? 0), Math.floor(height[0] ?? 0), 0);
    this.frame = { origin, rotation: LEVEL_ROTATION };
    const positions = new Float32Array(3 * count);
    const box = Float32Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
    for (let point = 0, at = 0; point < count; point++, at += 3) {
      positions[at] = chainage[point] - origin[0];
      positions[at + 1] = height[point] - origin[1];
      positions[at + 2] = -Math.abs(offset[point]);
      for (let axis = 0; axis < 3; axis++) {
        const value = positions[at + axis];
        if (value < box[axis]) box[axis] = value;
        if (value > box[axis + 3]) box[axis + 3] = value;
      }
    }
    this.positions = positions;
    this.box = box;
    this.bound = Math.max(...box.map(Math.abs)) * 2 ** -24;
  }

  #column(name: string): Column | undefined {
    const bits = this.#bits();
    if (bits !== this.#madeBits) this.#made.delete("rgb");
    this.#madeBits = bits;
    if (!this.#made.has(name)) this.#made.set(name, this.#make(name, bits));
    return this.#made.get(name);
  }

  #make(name: string, rgbBits: 8 | 16): Column | undefined {
    const { batch, offset } = this.#points;
    if (name === LEVEL) return constantColumn(LEVEL, [batch.key.depth]);
    if (name === OFFSET) return floats(OFFSET, Float32Array.from(offset));
    if (name === "ellipsoidalHeight") return this.#ellipsoidalHeight();
    const { scale, offset: from, appearance } = this.#cloud;
    const spec = { scale, offset: from, rgbBits, ranges: appearance?.ranges };
    return recordedColumn(name, batch.records, batch.inside, spec);
  }

  /**
   * Heights above WGS 84, metres: those of some points exactly, and between them what the ellipsoid lies below the recorded
   * heights, in proportion to the chainage. The bound is twice the greatest error at as many points between those.
   */
  #ellipsoidalHeight(): Column {
    const { chainage, height, batch } = this.#points;
    const heights = recordNumbers("ellipsoidalHeight", batch.records, this.#cloud, geodeticOf(this.#cloud))!;
    const above = (point: number) => heights.value(batch.inside[point]) - height[point];
    const step = Math.max(1, Math.ceil(this.count / KNOTS));
    const knots: { chainage: number; above: number }[] = [];
    for (let point = 0; point < this.count; point += step) {
      knots.push({ chainage: chainage[point], above: above(point) });
    }
    knots.sort((a, b) => a.chainage - b.chainage);
    let error = 0;
    for (let point = step >> 1; point < this.count; point += step) {
      error = Math.max(error, Math.abs(above(point) - between(knots, chainage[point])));
    }
    const data = new Float32Array(this.count);
    const origin = height[0] ?? 0;
    for (let point = 0; point < this.count; point++) {
      data[point] = height[point] + between(knots, chainage[point]) - origin;
    }
    return floats("ellipsoidalHeight", data, origin, 2 * error);
  }
}

/** @param error of the numbers before they were rounded to float32 */
function floats(name: string, data: Float32Array, offset = 0, error = 0): Column {
  let reach = 0;
  for (const value of data) reach = Math.max(reach, Math.abs(value));
  return { name, components: 1, data, scale: 1, offset, bound: error + halfUlp32(reach) };
}

/** The value at a chainage, in proportion between the knots around it. */
function between(knots: readonly { chainage: number; above: number }[], chainage: number): number {
  let [low, high] = [0, knots.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (knots[middle].chainage <= chainage) low = middle;
    else high = middle;
  }
  const [a, b] = [knots[low], knots[high]];
  const length = b.chainage - a.chainage;
  const share = length > 0 ? Math.min(1, Math.max(0, (chainage - a.chainage) / length)) : 0;
  return a.above + share * (b.above - a.above);
}

import { type Frame, WGS84 } from "@groma/georef";
import type { ColumnSink, DrawnPoints } from "./attribute-columns.js";
import { constantColumn, halfUlp32, type PlannedArray, planArray } from "./column-plan.js";
import type { StoredAttribute } from "./stored-attribute.js";

/** Names of the attributes that the column `rgb` stands for. */
export const COLOUR_CHANNELS: readonly string[] = ["red", "green", "blue"];

/** Red, green and blue of the points, of 8 or 16 bits each. */
export type Colours = readonly [red: StoredAttribute, green: StoredAttribute, blue: StoredAttribute];

/** The points' own colours; undefined where they have none that can be shown. */
export function coloursOf(attributes: readonly StoredAttribute[]): Colours | undefined {
  const channels = COLOUR_CHANNELS.map((channel) => attributes.find(({ name }) => name === channel));
  const [red, green, blue] = channels;
  if (!red || !green || !blue) return undefined;
  return channels.every((channel) => channel?.type === "uint16" || channel?.type === "uint8")
    ? [red, green, blue]
    : undefined;
}

/** Greatest colour value of the points. */
export function greatestColour(count: number, colours: Colours): number {
  let greatest = 0;
  for (const { bytes, at, stride, type } of colours) {
    const upper = type === "uint16" ? 1 : 0;
    for (let point = 0, from = at; point < count; point++, from += stride) {
      const value = upper === 0 ? bytes[from] : bytes[from] | (bytes[from + 1] << 8);
      if (value > greatest) greatest = value;
    }
  }
  return greatest;
}

/** Plans the column `rgb`: RGBA of 8 bits each; 16-bit colours are shown by their upper byte. */
export function planColour(
  { order, count, recorded = count }: DrawnPoints,
  colours: Colours,
  rgbBits: 8 | 16,
  sink: ColumnSink,
): PlannedArray | undefined {
  const lower = rgbBits === 16 && colours[0].type === "uint16" ? 1 : 0;
  if (colours.every((channel) => isOneByte(recorded, channel, lower))) {
    const constant = [...colours.map(({ bytes, at }) => bytes[at + lower]), 255];
    sink(constantColumn("rgb", constant, lower));
    return undefined;
  }
  return planArray(Uint8Array, 4 * count, (data) => {
    const [red, green, blue] = colours;
    const [r, g, b] = colours.map(({ at }) => at + lower);
    for (let point = 0, to = 0; point < count; point++, to += 4) {
      const from = order[point];
      data[to] = red.bytes[from * red.stride + r];
      data[to + 1] = green.bytes[from * green.stride + g];
      data[to + 2] = blue.bytes[from * blue.stride + b];
      data[to + 3] = 255;
    }
    sink({ name: "rgb", components: 4, data, scale: 1, offset: 0, bound: lower });
  });
}

/** Whether all points have the same in the byte that is shown. */
function isOneByte(count: number, { bytes, at, stride }: StoredAttribute, lower: number): boolean {
  const first = bytes[at + lower];
  for (let point = 1, from = at + lower + stride; point < count; point++, from += stride) {
    if (bytes[from] !== first) return false;
  }
  return true;
}

/**
 * Plans the column `elevation`: z as recorded, source units, counted from a height.
 * @param xyz LAS integers in the order of the chunk
 */
export function planElevation(
  { order, count }: DrawnPoints,
  xyz: Int32Array,
  range: readonly [number, number],
  scale: number,
  offset: number,
  origin: number,
  sink: ColumnSink,
): PlannedArray | undefined {
  const [least, greatest] = range;
  if (least === greatest) {
    sink(constantColumn("elevation", [least * scale + offset]));
    return undefined;
  }
  return planArray(Float32Array, count, (data) => {
    const from = offset - origin;
    for (let point = 0; point < count; point++) data[point] = xyz[3 * order[point] + 2] * scale + from;
    const reach = Math.max(Math.abs(least * scale + from), Math.abs(greatest * scale + from));
    sink({ name: "elevation", components: 1, data, scale: 1, offset: origin, bound: halfUlp32(reach) });
  });
}

/**
 * Metres that {@link heightOf} may be off for heights of −10 km to 20,000 km: Bowring's latitude is wrong by less than
 * 1e-8 radians there, and a wrong latitude counts by its square.
 */
const BOWRING_ERROR = 1e-6;

/**
 * Plans the column `ellipsoidalHeight`: metres above WGS84, counted from a height, of the points as they are placed.
 * Latitude by B. R. Bowring, "Transformation from spatial to geographical coordinates", Survey Review 181 (1976), one
 * step, without trigonometric functions; then h = p cos φ + z sin φ − a √(1 − e² sin² φ).
 * @param positions metres in the node frame, drawing order
 * @param bound of the positions, metres
 */
export function planHeight(
  positions: () => Float32Array,
  count: number,
  { origin: [x0, y0, z0], rotation }: Frame,
  bound: number,
  origin: number,
  sink: ColumnSink,
): PlannedArray {
  const [ex, ey, ez, nx, ny, nz, ux, uy, uz] = rotation;
  const { a, f, e2 } = WGS84;
  const b = a * (1 - f);
  const north3 = (e2 / (1 - e2)) * b;
  const out3 = e2 * a;
  return planArray(Float32Array, count, (data) => {
    const local = positions();
    let reach = 0;
    for (let point = 0, at = 0; point < count; point++, at += 3) {
      const east = local[at];
      const north = local[at + 1];
      const up = local[at + 2];
      const x = x0 + ex * east + nx * north + ux * up;
      const y = y0 + ey * east + ny * north + uy * up;
      const z = z0 + ez * east + nz * north + uz * up;
      const p = Math.sqrt(x * x + y * y);
      // Sine and cosine of the reduced latitude; on the axis the height is that above a pole.
      const za = z * a;
      const pb = p * b;
      const reduced = 1 / Math.sqrt(za * za + pb * pb);
      const sinReduced = za * reduced;
      const cosReduced = pb * reduced;
      const opposite = z + north3 * sinReduced * sinReduced * sinReduced;
      const adjacent = p - out3 * cosReduced * cosReduced * cosReduced;
      const length = 1 / Math.sqrt(opposite * opposite + adjacent * adjacent);
      const sine = opposite * length;
      const height = p * adjacent * length + z * sine - a * Math.sqrt(1 - e2 * sine * sine) - origin;
      data[point] = height;
      const size = height < 0 ? -height : height;
      if (size > reach) reach = size;
    }
    const off = bound + BOWRING_ERROR + halfUlp32(reach);
    sink({ name: "ellipsoidalHeight", components: 1, data, scale: 1, offset: origin, bound: off });
  });
}

/**
 * The same of points on a map, whose third coordinate it is.
 * @param positions metres in the node frame, drawing order
 * @param bound of the positions, metres
 */
export function planLevelHeight(
  positions: () => Float32Array,
  count: number,
  { origin: frameOrigin }: Frame,
  bound: number,
  origin: number,
  sink: ColumnSink,
): PlannedArray {
  const from = frameOrigin[2] - origin;
  return planArray(Float32Array, count, (data) => {
    const local = positions();
    let reach = 0;
    for (let point = 0; point < count; point++) {
      const height = local[3 * point + 2] + from;
      data[point] = height;
      reach = Math.max(reach, Math.abs(height));
    }
    const off = bound + halfUlp32(reach);
    sink({ name: "ellipsoidalHeight", components: 1, data, scale: 1, offset: origin, bound: off });
  });
}

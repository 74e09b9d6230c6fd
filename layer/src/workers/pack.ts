import { VERTEX_STRIDE } from "./protocol.js";
import type { Records } from "./records.js";

/** How attributes come to the few bits of a vertex. */
export interface PackOptions {
  /** Bits per colour channel that the data set uses. */
  readonly rgbBits: 8 | 16;
  /** LAS integer of z at elevation 0. */
  readonly lowest: number;
  /** LAS integer of z at elevation 65535. */
  readonly highest: number;
}

/**
 * Packs placed records into one interleaved vertex buffer; the layout is that of `NodeVertices.vertices`.
 * Without colours a vertex is white.
 * @param positions 3 float32 per point, metres in the node frame
 */
export function packVertices(positions: Float32Array, records: Records, options: PackOptions): ArrayBuffer {
  const { count, xyz, intensity, rgb } = records;
  const buffer = new ArrayBuffer(count * VERTEX_STRIDE);
  const floats = new Float32Array(buffer);
  const bytes = new Uint8Array(buffer);
  const shorts = new Uint16Array(buffer);
  const { lowest, highest } = options;
  const perStep = highest > lowest ? 65535 / (highest - lowest) : 0;
  // 16-bit colours are shown by their upper byte.
  const shift = options.rgbBits === 16 ? 8 : 0;
  for (let point = 0; point < count; point++) {
    const from = 3 * point;
    const float = (point * VERTEX_STRIDE) / 4;
    floats[float] = positions[from];
    floats[float + 1] = positions[from + 1];
    floats[float + 2] = positions[from + 2];
    const byte = point * VERTEX_STRIDE + 12;
    bytes[byte] = rgb ? rgb[from] >> shift : 255;
    bytes[byte + 1] = rgb ? rgb[from + 1] >> shift : 255;
    bytes[byte + 2] = rgb ? rgb[from + 2] >> shift : 255;
    bytes[byte + 3] = 255;
    const short = (point * VERTEX_STRIDE) / 2 + 8;
    shorts[short] = intensity[point];
    shorts[short + 1] = Math.max(0, Math.min(65535, Math.round((xyz[from + 2] - lowest) * perStep)));
  }
  return buffer;
}

/** Least and greatest position: min x, y, z, max x, y, z, metres in the node frame. */
export function positionBox(positions: Float32Array): Float32Array {
  const box = Float32Array.of(Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity);
  for (let at = 0; at < positions.length; at += 3) {
    for (let axis = 0; axis < 3; axis++) {
      const value = positions[at + axis];
      if (value < box[axis]) box[axis] = value;
      if (value > box[axis + 3]) box[axis + 3] = value;
    }
  }
  return box;
}

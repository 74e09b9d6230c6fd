import type { ProfilePoints } from "@groma/layer/tools";

/** What points are coloured by. */
export interface PointColours {
  readonly by: "rgb" | "classification" | "intensity" | "offset" | "plain" | "second";
  /** Bits that the scan's own colours have. */
  readonly bits: 8 | 16;
  /** Colours of the classes, sRGB from 0 to 1, as the layer has them. */
  readonly classes?: ReadonlyMap<number, readonly [number, number, number]> | undefined;
}

/** Colour of points without colours of their own. */
const PLAIN = [173, 188, 203] as const;

/** Colour of the points of a second cloud. */
const SECOND = [90, 209, 230] as const;

/** Colours at the edges of the strip. */
const LEFT = [60, 140, 245] as const;
const RIGHT = [245, 140, 50] as const;

type ReadNumber = (record: number) => number;

/** Colour of each point, 4 bytes. */
export function coloursOf(points: ProfilePoints, { by, bits, classes }: PointColours): Uint8Array {
  const { inside } = points.batch;
  const colours = new Uint8Array(4 * inside.length);
  const put = (index: number, [red, green, blue]: readonly [number, number, number]) => {
    colours[4 * index] = red;
    colours[4 * index + 1] = green;
    colours[4 * index + 2] = blue;
    colours[4 * index + 3] = 255;
  };
  const paint = painter(points, by, bits, classes);
  for (let index = 0; index < inside.length; index++) put(index, paint(inside[index]!, index));
  return colours;
}

function painter(
  points: ProfilePoints,
  by: PointColours["by"],
  bits: 8 | 16,
  classes: PointColours["classes"],
): (record: number, index: number) => readonly [number, number, number] {
  if (by === "second") return () => SECOND;
  if (by === "rgb") {
    const [red, green, blue] = ["red", "green", "blue"].map((name) => reader(points, name, 2));
    const shift = bits === 16 ? 8 : 0;
    if (red && green && blue)
      return (record) => [red(record) >> shift, green(record) >> shift, blue(record) >> shift];
  }
  if (by === "classification") {
    const read = reader(points, "classification", 1);
    const known = new Map([...(classes ?? [])].map(([code, parts]) => [code, bytesOf(parts)]));
    if (read) return (record) => known.get(read(record)) ?? PLAIN;
  }
  if (by === "intensity") {
    const read = reader(points, "intensity", 2);
    if (read) {
      let most = 1;
      for (const record of points.batch.inside) most = Math.max(most, read(record));
      return (record) => {
        const grey = 40 + Math.round((215 * read(record)) / most);
        return [grey, grey, grey];
      };
    }
  }
  if (by === "offset") {
    let most = 1e-9;
    for (const offset of points.offset) most = Math.max(most, Math.abs(offset));
    // Blue to the left, orange to the right, grey on the line.
    return (_, index) => {
      const share = points.offset[index]! / most;
      const [red, green, blue] = share > 0 ? LEFT : RIGHT;
      const mixed = (plain: number, end: number) => plain + Math.abs(share) * (end - plain);
      return [mixed(PLAIN[0], red), mixed(PLAIN[1], green), mixed(PLAIN[2], blue)];
    };
  }
  return () => PLAIN;
}

/** Reads a plain whole number of 1 or 2 bytes. */
function reader({ batch: { records } }: ProfilePoints, name: string, bytes: 1 | 2): ReadNumber | undefined {
  const found = records.attributes.find((one) => one.name === name);
  if (!found) return undefined;
  const { at, stride, bytes: from } = found;
  const view = new DataView(from.buffer, from.byteOffset, from.byteLength);
  return bytes === 1
    ? (record) => view.getUint8(at + record * stride)
    : (record) => view.getUint16(at + record * stride, true);
}

function bytesOf([red, green, blue]: readonly [number, number, number]): readonly [number, number, number] {
  return [255 * red, 255 * green, 255 * blue];
}

import type { ProfilePoints } from "@groma/layer/tools";

/** Colour of points without colours of their own. */
const PLAIN = [173, 188, 203] as const;

/** Chainage and height of each point as they go to the GPU, float32 metres from the origin given: 2 numbers a point. */
export function placesOf({ chainage, height }: ProfilePoints, origin: number): Float32Array {
  const places = new Float32Array(2 * chainage.length);
  for (let point = 0; point < chainage.length; point++) {
    places[2 * point] = chainage[point]!;
    places[2 * point + 1] = height[point]! - origin;
  }
  return places;
}

/** Colour of each point, 4 bytes. @param bits that the scan's own colours have */
export function coloursOf({ batch }: ProfilePoints, bits: 8 | 16): Uint8Array {
  const { records, inside } = batch;
  const channels = ["red", "green", "blue"].map((name) =>
    records.attributes.find((one) => one.name === name),
  );
  const colours = new Uint8Array(4 * inside.length);
  const shift = bits === 16 ? 8 : 0;
  for (const [channel, attribute] of channels.entries()) {
    const view =
      attribute &&
      new DataView(attribute.bytes.buffer, attribute.bytes.byteOffset, attribute.bytes.byteLength);
    for (let index = 0; index < inside.length; index++) {
      const value =
        view && attribute
          ? view.getUint16(attribute.at + inside[index]! * attribute.stride, true) >> shift
          : PLAIN[channel]!;
      colours[4 * index + channel] = value;
    }
  }
  for (let at = 3; at < colours.length; at += 4) colours[at] = 255;
  return colours;
}

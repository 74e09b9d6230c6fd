/**
 * A number as the sum of two float32, for arithmetic in shaders: 48 bits of the mantissa instead of 24, which is 1e-7 m
 * at the distance of the earth's radius.
 */
export function splitFloat32(value: number): readonly [high: number, low: number] {
  const high = Math.fround(value);
  return [high, Math.fround(value - high)];
}

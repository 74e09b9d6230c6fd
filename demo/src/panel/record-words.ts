import type { RecordValue } from "@groma/layer/cesium";
import { fixed, several } from "../language/numbers.js";

/** Source coordinates with as many digits as their integers hold, whatever the float64 would print. */
export function coordinateWords(source: readonly number[], scale: readonly number[]): string {
  return several(source.map((value, axis) => fixed(value, digitsOf(scale[axis]!))));
}

/** Decimal digits that a step of the integer grid needs. */
function digitsOf(step: number): number {
  for (let digits = 0; digits < 12; digits++) {
    const whole = step * 10 ** digits;
    if (Math.abs(whole - Math.round(whole)) < 1e-9 * whole && Math.round(whole) >= 1) return digits;
  }
  return 12;
}

/** An angle in degrees to about a millimetre on the ground. @param radians the angle */
export function degreeWords(radians: number): string {
  return `${fixed((radians * 180) / Math.PI, 8)}°`;
}

/** A recorded value as it is. */
export function valueWords(value: RecordValue): string {
  return typeof value === "object" ? value.map(String).join(", ") : String(value);
}

import type { GridWindow } from "@groma/georef";

/** In place of a grid's file name. */
export const CONSTANT = "constant offset";

/** A grid of one cell round the earth with the same values everywhere: what a step adds that needs no grid. */
export function constantWindow(values: readonly number[]): GridWindow {
  return {
    grid: CONSTANT,
    ...{ west: -Math.PI, south: -Math.PI / 2, stepLongitude: 2 * Math.PI, stepLatitude: Math.PI },
    ...{ columns: 2, rows: 2, channels: values.length, unit: 1 },
    values: Float32Array.from(values.flatMap((value) => [value, value, value, value])),
  };
}

/** Two of them, since the values of a grid are float32: the shift (radians), and what rounding it to float32 leaves. */
export function constantShift(...shift: readonly [number, number]): GridWindow[] {
  return [constantWindow(shift), constantWindow(shift.map((value) => value - Math.fround(value)))];
}

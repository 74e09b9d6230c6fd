import type { GridWindow } from "./window.js";

/**
 * The values of a grid as a function of the place. Writes for each channel c the value and its derivatives by
 * longitude and latitude (radians) at `out[3c]` …, all in radians (shifts) or metres (heights); NaN where there are none.
 */
export type Surface = (longitude: number, latitude: number, out: Float64Array) => void;

/** Cells beyond the outermost nodes that still count as on them: PROJ forgives as much (its tolerance is 1e-4 cells). */
const EDGE = 1e-4;

const TURN = 2 * Math.PI;

/** Position in a window in cells: from the westernmost column, on the turn nearest to the window's middle. */
export function columnAt(window: GridWindow, longitude: number): number {
  const span = (window.columns - 1) * window.stepLongitude;
  const east = longitude - window.west;
  // Only far outside, so that nothing is lost in the last digits of the ordinary case.
  if (east >= 0 && east <= span) return east / window.stepLongitude;
  return (east - TURN * Math.round((east - span / 2) / TURN)) / window.stepLongitude;
}

/** Position in a window in cells, from the southernmost row. */
export function rowAt(window: GridWindow, latitude: number): number {
  return (latitude - window.south) / window.stepLatitude;
}

/** Whether the node of this value holds no data. */
export function isNoData(window: GridWindow, value: number): boolean {
  return !Number.isFinite(value) || value === window.noData;
}

/** The nodes of a window in radians or metres, rounded to float32 once more as PROJ holds them. */
function nodeValues({ values, unit }: GridWindow): Float32Array {
  return unit === 1 ? values : values.map((value) => value * unit);
}

/**
 * The window interpolated bilinearly in float64 from float32 nodes, as PROJ does it.
 *
 * @param holes what a cell with some nodes without data gives: `renormalised` the mean of the others with their
 *   weights (PROJ's vertical grids), `refused` nothing (its horizontal ones)
 */
export function bilinear(window: GridWindow, holes: "renormalised" | "refused"): Surface {
  const { columns, rows, channels, stepLongitude, stepLatitude } = window;
  const values = nodeValues(window);
  const plane = columns * rows;
  const anyHole = window.values.some((value) => isNoData(window, value));

  const holeAt = (at: number) =>
    [at, at + 1, at + columns, at + columns + 1].some((node) => isNoData(window, window.values[node]));

  return (longitude, latitude, out) => {
    let u = columnAt(window, longitude);
    let v = rowAt(window, latitude);
    if (!(u >= -EDGE && v >= -EDGE && u <= columns - 1 + EDGE && v <= rows - 1 + EDGE)) {
      out.fill(Number.NaN, 0, 3 * channels);
      return;
    }
    const column = Math.max(0, Math.min(columns - 2, Math.floor(u)));
    const row = Math.max(0, Math.min(rows - 2, Math.floor(v)));
    u = Math.max(0, Math.min(1, u - column));
    v = Math.max(0, Math.min(1, v - row));
    for (let c = 0; c < channels; c++) {
      const at = c * plane + row * columns + column;
      const southWest = values[at];
      const southEast = values[at + 1];
      const northWest = values[at + columns];
      const northEast = values[at + columns + 1];
      if (anyHole && holeAt(at)) {
        if (holes === "refused") out.fill(Number.NaN, 3 * c, 3 * c + 3);
        else ofOthers(window, at, u, v, out, 3 * c);
        continue;
      }
      const south = southWest + u * (southEast - southWest);
      const north = northWest + u * (northEast - northWest);
      out[3 * c] = south + v * (north - south);
      out[3 * c + 1] =
        (southEast - southWest + v * (northEast - northWest - southEast + southWest)) / stepLongitude;
      out[3 * c + 2] = (north - south) / stepLatitude;
    }
  };
}

/**
 * The nodes of a cell that hold data, by their weights: (Σ w·value) / Σ w, with the derivatives of the quotient.
 *
 * @param southWest index of the cell's first node in the window's values
 */
function ofOthers(
  window: GridWindow,
  southWest: number,
  u: number,
  v: number,
  out: Float64Array,
  offset: number,
): void {
  const weights = [(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v];
  const byColumn = [v - 1, 1 - v, -v, v];
  const byRow = [u - 1, -u, 1 - u, u];
  const { values, columns } = window;
  const corners = [0, 1, columns, columns + 1].map((step) => values[southWest + step]);
  let sum = 0;
  let weight = 0;
  const slope = [0, 0, 0, 0];
  for (let i = 0; i < 4; i++) {
    if (isNoData(window, corners[i])) continue;
    sum += weights[i] * corners[i];
    weight += weights[i];
    slope[0] += byColumn[i] * corners[i];
    slope[1] += byColumn[i];
    slope[2] += byRow[i] * corners[i];
    slope[3] += byRow[i];
  }
  const value = sum / weight;
  out[offset] = value * window.unit;
  out[offset + 1] = (((slope[0] - value * slope[1]) / weight) * window.unit) / window.stepLongitude;
  out[offset + 2] = (((slope[2] - value * slope[3]) / weight) * window.unit) / window.stepLatitude;
}

import { roundStep } from "./picture/layout.js";
import type { AlongLine } from "./selection.js";

/** Where straightened points lie: chainage and height. */
export interface StraightenedExtent {
  readonly from: number;
  readonly to: number;
  readonly low: number;
  readonly high: number;
}

/** Stretches of the grid along and up, about. */
const ALONG = 20;
const UP = 8;

/** Group codes of DXF and their values, each on a line. */
export function groups(...pairs: readonly (readonly [code: number, value: string | number])[]): string {
  return pairs.map(([code, value]) => `${code}\n${value}\n`).join("");
}

/** A grid in round numbers around straightened points, on the layer `GRID`, with its numbers on `TEXT`. */
export function gridOf({ from, to, low, high }: StraightenedExtent): string {
  const step = { along: roundStep((to - from) / ALONG), up: roundStep(Math.max(high - low, 1e-3) / UP) };
  const [bottom, top] = [Math.floor(low / step.up) * step.up, Math.ceil(high / step.up) * step.up];
  const size = Math.min(step.along, step.up) / 6;
  let text = "";
  for (let at = Math.ceil(from / step.along - 1e-9); at * step.along <= to + 1e-9 * step.along; at++) {
    const x = at * step.along;
    text += line(x, bottom, x, top) + label(x, bottom - 2 * size, size, number(x, step.along));
  }
  for (let at = Math.round(bottom / step.up); at * step.up <= top + 1e-9 * step.up; at++) {
    const y = at * step.up;
    text += line(from, y, to, y) + label(from - 6 * size, y, size, number(y, step.up));
  }
  return text;
}

/** The station of each vertex of a line beside it, on the layer `TEXT`. @param stationOf of a chainage */
export function stationsOf(
  { vertices, chainages }: AlongLine,
  stationOf: (chainage: number) => number,
): string {
  const length = chainages[chainages.length - 1] - chainages[0];
  const size = roundStep(length / 200);
  // An alignment of many chords would be covered with numbers: at most some fifty are written.
  const every = Math.ceil(vertices.length / 50);
  return vertices
    .map(([x, y], index) =>
      index % every === 0 || index === vertices.length - 1
        ? label(x, y, size, stationOf(chainages[index]).toFixed(2))
        : "",
    )
    .join("");
}

function line(ax: number, ay: number, bx: number, by: number): string {
  return groups([0, "LINE"], [8, "GRID"], [10, ax], [20, ay], [30, 0], [11, bx], [21, by], [31, 0]);
}

function label(x: number, y: number, size: number, text: string): string {
  return groups([0, "TEXT"], [8, "TEXT"], [10, x], [20, y], [30, 0], [40, size], [1, text]);
}

/** A number with as many digits as its step has. */
function number(value: number, step: number): string {
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

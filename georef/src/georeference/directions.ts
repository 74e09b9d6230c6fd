import { CHEBYSHEV_NODES, NODES } from "../approximation/chebyshev.js";
import type { Surface } from "../grid/surface.js";
import type { GridStep } from "../transformation/compile.js";
import type { Link } from "../transformation/link.js";
import { BOTTOM, MIDDLE, type NodeSamples, TOP } from "./node-samples.js";

/** How a value of a grid moves points: linear functions over a node, metres of ECEF per radian or metre. */
export interface DirectionFit {
  /** Three numbers per channel: at the node's centre, and the change with u and with v. */
  readonly centre: Float64Array;
  readonly byU: Float64Array;
  readonly byV: Float64Array;
  /** By channel: greatest length. */
  readonly greatest: Float64Array;
  /** By channel: how far a direction may be from its linear function, change with height included. */
  readonly error: Float64Array;
}

/** The samples looked at, of the nine per direction: the outermost and the middle. */
const LINE = [0, (NODES - 1) / 2, NODES - 1];
/** Between the deviations at these few samples and the greatest one: they grow with the square of the distance. */
const BETWEEN_SAMPLES = 2;

/**
 * Derivatives of ECEF by the values of a grid, through all steps from the grid's own on.
 *
 * @param surface the smooth part that stands for the grid
 * @param links the grid's step and those after it
 * @param states the samples before the grid's step
 */
export function fitDirections(
  step: GridStep,
  surface: Surface,
  links: readonly Link[],
  samples: NodeSamples,
  states: Float64Array,
): DirectionFit {
  const channels = step.kind === "horizontalShift" ? 2 : 1;
  const slopes = new Float64Array(3 * step.window.channels);
  const state = new Float64Array(3);
  const jacobian = new Float64Array(9);

  /** 3 × channels: metres of ECEF per unit of each channel. */
  const directionsAt = (i: number, j: number, height: number): Float64Array => {
    samples.read(states, i, j, height, state);
    links[0].apply(state);
    jacobian.fill(0);
    jacobian[0] = jacobian[4] = jacobian[8] = 1;
    surface(state[0], state[1], slopes);
    for (const link of links.slice(1)) link.differentiate(state, jacobian);
    const out = new Float64Array(3 * channels);
    for (let axis = 0; axis < 3; axis++) {
      const [byLongitude, byLatitude, byHeight] = jacobian.subarray(3 * axis);
      if (step.kind === "verticalShift") {
        out[axis] = step.multiplier * byHeight;
      } else if (step.direction === "forward") {
        out[axis] = byLongitude;
        out[3 + axis] = byLatitude;
      } else {
        // q = p − shift(q): dq = −(1 + d shift / dq)⁻¹ · d shift.
        const determinant = (1 + slopes[1]) * (1 + slopes[5]) - slopes[2] * slopes[4];
        out[axis] = (-(1 + slopes[5]) * byLongitude + slopes[4] * byLatitude) / determinant;
        out[3 + axis] = (slopes[2] * byLongitude - (1 + slopes[1]) * byLatitude) / determinant;
      }
    }
    return out;
  };

  const middle = LINE[1];
  const outermost = CHEBYSHEV_NODES[LINE[0]];
  const centre = directionsAt(middle, middle, MIDDLE);
  const half = (plus: Float64Array, minus: Float64Array, reach: number) =>
    plus.map((value, k) => (value - minus[k]) / (2 * reach));
  const byU = half(directionsAt(LINE[0], middle, MIDDLE), directionsAt(LINE[2], middle, MIDDLE), outermost);
  const byV = half(directionsAt(middle, LINE[0], MIDDLE), directionsAt(middle, LINE[2], MIDDLE), outermost);
  const greatest = new Float64Array(channels);
  const error = new Float64Array(channels);
  for (const i of LINE) {
    for (const j of LINE) {
      for (const height of [BOTTOM, MIDDLE, TOP]) {
        const there = directionsAt(i, j, height);
        const [u, v] = [CHEBYSHEV_NODES[i], CHEBYSHEV_NODES[j]];
        const off = there.map((value, k) => value - centre[k] - u * byU[k] - v * byV[k]);
        for (let c = 0; c < channels; c++) {
          greatest[c] = Math.max(greatest[c], length(there, c));
          error[c] = Math.max(error[c], BETWEEN_SAMPLES * length(off, c));
        }
      }
    }
  }
  // Length grows towards the corners as the rest does.
  return { centre, byU, byV, greatest: greatest.map((value, c) => value + error[c]), error };
}

/** Length of one of several vectors. */
export function length(vectors: Float64Array, c: number): number {
  return Math.hypot(vectors[3 * c], vectors[3 * c + 1], vectors[3 * c + 2]);
}

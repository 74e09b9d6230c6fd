import type { Surface } from "../grid/surface.js";
import { combine, type GridLink } from "./link.js";
import type { HorizontalShiftStep, VerticalShiftStep } from "./step.js";

/** PROJ's limits for the inverse of a grid shift: radians, and turns of the iteration. */
const TOLERANCE = 1e-12;
const ITERATIONS = 10;

/** Longitude and latitude plus the shift found there. */
export function horizontalShiftLink({ direction, window }: HorizontalShiftStep, surface: Surface): GridLink {
  const shift = new Float64Array(3 * window.channels);
  if (direction === "inverse") return inverseShiftLink(window, surface, shift);
  return {
    window,
    apply(state) {
      surface(state[0], state[1], shift);
      state[0] += shift[0];
      state[1] += shift[3];
    },
    differentiate(state, jacobian) {
      surface(state[0], state[1], shift);
      state[0] += shift[0];
      state[1] += shift[3];
      multiplyRows(jacobian, 1 + shift[1], shift[2], shift[4], 1 + shift[5]);
    },
  };
}

/** Solves q + shift(q) = p by the fixed-point iteration that PROJ uses. */
function inverseShiftLink(
  window: HorizontalShiftStep["window"],
  surface: Surface,
  shift: Float64Array,
): GridLink {
  const apply = (state: Float64Array) => {
    const longitude = state[0];
    const latitude = state[1];
    surface(longitude, latitude, shift);
    let ownLongitude = longitude - shift[0];
    let ownLatitude = latitude - shift[3];
    for (let i = 0; i < ITERATIONS; i++) {
      surface(ownLongitude, ownLatitude, shift);
      const east = ownLongitude + shift[0] - longitude;
      const north = ownLatitude + shift[3] - latitude;
      ownLongitude -= east;
      ownLatitude -= north;
      if (east * east + north * north <= TOLERANCE * TOLERANCE) {
        state[0] = ownLongitude;
        state[1] = ownLatitude;
        return;
      }
    }
    state.fill(Number.NaN);
  };
  return {
    window,
    apply,
    differentiate(state, jacobian) {
      apply(state);
      // The last look-up stands at the solution to within the tolerance.
      const determinant = (1 + shift[1]) * (1 + shift[5]) - shift[2] * shift[4];
      multiplyRows(
        jacobian,
        (1 + shift[5]) / determinant,
        -shift[2] / determinant,
        -shift[4] / determinant,
        (1 + shift[1]) / determinant,
      );
    },
  };
}

/** The rows of longitude and latitude times a 2 × 2 matrix. */
function multiplyRows(jacobian: Float64Array, a: number, b: number, c: number, d: number): void {
  for (let column = 0; column < 3; column++) {
    const longitude = jacobian[column];
    const latitude = jacobian[3 + column];
    jacobian[column] = a * longitude + b * latitude;
    jacobian[3 + column] = c * longitude + d * latitude;
  }
}

/** Height plus the multiple of the grid's value. */
export function verticalShiftLink({ multiplier, window }: VerticalShiftStep, surface: Surface): GridLink {
  const height = new Float64Array(3 * window.channels);
  return {
    window,
    apply(state) {
      surface(state[0], state[1], height);
      state[2] += multiplier * height[0];
    },
    differentiate(state, jacobian) {
      surface(state[0], state[1], height);
      state[2] += multiplier * height[0];
      combine(jacobian, 2, 1, 0, multiplier * height[1]);
      combine(jacobian, 2, 1, 1, multiplier * height[2]);
    },
  };
}

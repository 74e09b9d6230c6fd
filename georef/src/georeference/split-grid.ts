import { chebyshevCoefficients, geometricTail, NODES } from "../approximation/chebyshev.js";
import { type CellRange, type SmoothPart, smoothPart } from "../grid/smooth-surface.js";
import { columnAt, rowAt } from "../grid/surface.js";
import { type GridStep, linkOf } from "../transformation/compile.js";
import type { Link } from "../transformation/link.js";
import { type DirectionFit, fitDirections, length as lengthOf } from "./directions.js";
import { type GridRemainder, POSITION_TERMS, remainderOf } from "./grid-remainder.js";
import { BOTTOM, MIDDLE, type NodeSamples, TOP } from "./node-samples.js";

/** One grid of a transformation over a node, split into a smooth part and a remainder. */
export interface GridPart {
  /** The step with the smooth part in place of the grid. */
  readonly link: Link;
  /**
   * What remains, once all steps are known.
   *
   * @param links all steps, smooth parts in place of grids
   * @param shift metres by which the remainders of earlier grids move the place where this one is looked up
   */
  finish(links: readonly Link[], shift: number): FinishedPart;
}

/** What one grid leaves of itself in a node. */
export interface FinishedPart {
  /** Displacements along the axes of ECEF. */
  readonly remainder: GridRemainder;
  /** Greatest length of the correction, metres. */
  readonly length: number;
  /** How far the correction may be off, metres; infinite where points move too far for the range looked at. */
  readonly error: number;
}

/** Cells by which the range of a node is widened: room for what moves its points a little. */
const MARGIN = 2e-3;

/** Metres per radian, at least. */
const RADIUS = 6.3e6;

/** Splits the grid of a step for samples that stand before it. Returns nothing where nodes without data are near. */
export function splitGrid(step: GridStep, samples: NodeSamples, index: number): GridPart | undefined {
  const { window } = step;
  const positions = fitPositions(step, samples);
  if (!positions) return undefined;
  const part = smoothPart(window, positions.range);
  if (!part) return undefined;
  const link = linkOf(step, () => part.surface);
  const before = samples.snapshot();
  return {
    link,
    finish: (links, shift) => {
      const directions = fitDirections(step, part.surface, links.slice(index), samples, before);
      return finish(step, part, positions, directions, shift);
    },
  };
}

function finish(
  step: GridStep,
  part: SmoothPart,
  positions: PositionFit,
  directions: DirectionFit,
  shift: number,
): FinishedPart {
  const { window, kind } = step;
  const channels = directions.greatest.length;
  let length = 0;
  for (let c = 0; c < channels; c++) length += part.greatest[c] * directions.greatest[c];

  // The solution of an inverse shift is itself moved by what remains; all others by the grids before them.
  const moved = shift + (kind === "horizontalShift" && step.direction === "inverse" ? length : 0);
  const errorColumn = positions.errorColumn + moved / (window.stepLongitude * positions.cosLatitude * RADIUS);
  const errorRow = positions.errorRow + moved / (window.stepLatitude * RADIUS);
  const position = positions.terms.slice();
  position[0] -= part.column;
  position[POSITION_TERMS] -= part.row;
  const [toU, toV] = invertedAffine(position);
  const quadratic = (at: number) =>
    position.subarray(at + 3, at + 6).reduce((sum, term) => sum + Math.abs(term), 0);
  const bent = Math.max(quadratic(0), quadratic(POSITION_TERMS));

  const nodes = new Float64Array(3 * part.rows * part.columns);
  let error = errorColumn < MARGIN && errorRow < MARGIN ? 0 : Number.POSITIVE_INFINITY;
  for (let c = 0; c < channels; c++) {
    const [centre, byU, byV] = [directions.centre, directions.byU, directions.byV].map((all) =>
      all.subarray(3 * c, 3 * c + 3),
    );
    const byColumn = centre.map((_, axis) => byU[axis] * toU[1] + byV[axis] * toV[1]);
    const byRow = centre.map((_, axis) => byU[axis] * toU[2] + byV[axis] * toV[2]);
    for (let row = 0; row < part.rows; row++) {
      for (let column = 0; column < part.columns; column++) {
        const at = row * part.columns + column;
        const value = part.remainder[c * part.rows * part.columns + at];
        for (let axis = 0; axis < 3; axis++) {
          const start = centre[axis] + toU[0] * byU[axis] + toV[0] * byV[axis];
          nodes[3 * at + axis] += value * (start + column * byColumn[axis] + row * byRow[axis]);
        }
      }
    }
    const slope = part.slopeColumn[c] + part.slopeRow[c];
    const turn = lengthOf(byColumn, 0) + lengthOf(byRow, 0);
    error +=
      (part.slopeColumn[c] * errorColumn + part.slopeRow[c] * errorRow) * directions.greatest[c] +
      part.greatest[c] * (directions.error[c] + turn * bent) +
      // The product of value and direction is interpolated, not its factors: their covariance within a cell.
      (slope * turn) / 4;
  }
  return { remainder: remainderOf(nodes, part.columns - 1, part.rows - 1, position), length, error };
}

/**
 * u and v as linear functions 1, column, row of the position, its quadratic terms left out. Not finite for a node
 * without width, which then does without its remainder.
 */
function invertedAffine(p: Float64Array): [u: Float64Array, v: Float64Array] {
  const determinant = p[1] * p[8] - p[2] * p[7];
  return [
    Float64Array.of(-p[8] * p[0] + p[2] * p[6], p[8], -p[2]).map((term) => term / determinant),
    Float64Array.of(p[7] * p[0] - p[1] * p[6], -p[7], p[1]).map((term) => term / determinant),
  ];
}

interface PositionFit {
  readonly range: CellRange;
  /** As `GridRemainder.position`, counted from the window's first node. */
  readonly terms: Float64Array;
  /** Certified error in cells, change with height included. */
  readonly errorColumn: number;
  readonly errorRow: number;
  readonly cosLatitude: number;
}

/** Where the points of a node look the grid up: quadratic functions of u and v, and how good these are. */
function fitPositions(step: GridStep, samples: NodeSamples): PositionFit | undefined {
  const states = samples.snapshot();
  const { window } = step;
  // An inverse shift is looked up at its solution, the others where the point stands.
  const lookUp = step.kind === "horizontalShift" && step.direction === "inverse" ? linkOf(step) : undefined;
  const state = new Float64Array(3);
  const values = new Float64Array(2 * NODES * NODES);
  const byHeight = [0, 0];
  let cosLatitude = 1;
  for (let i = 0; i < NODES; i++) {
    for (let j = 0; j < NODES; j++) {
      const place = (height: number): [number, number] => {
        samples.read(states, i, j, height, state);
        lookUp?.apply(state);
        return [columnAt(window, state[0]), rowAt(window, state[1])];
      };
      const middle = place(MIDDLE);
      cosLatitude = Math.min(cosLatitude, Math.cos(state[1]));
      values.set(middle, 2 * (NODES * i + j));
      for (const other of [place(BOTTOM), place(TOP)]) {
        for (const axis of [0, 1])
          byHeight[axis] = Math.max(byHeight[axis], Math.abs(other[axis] - middle[axis]));
      }
    }
  }
  if (!values.every(Number.isFinite)) return undefined;
  const coefficients = chebyshevCoefficients(values, 2);
  const terms = new Float64Array(2 * POSITION_TERMS);
  const error: number[] = [];
  const reach: number[] = [];
  for (const axis of [0, 1]) {
    const at = (k: number, l: number) => coefficients[2 * (NODES * k + l) + axis];
    const norm = (k: number, l: number) => Math.abs(at(k, l));
    const [uu, vv] = [at(2, 0), at(0, 2)];
    terms.set([at(0, 0) - uu - vv, at(1, 0), at(0, 1), 2 * uu, at(1, 1), 2 * vv], POSITION_TERMS * axis);
    let kept = 0;
    let discarded = 0;
    for (let k = 0; k < NODES; k++) {
      for (let l = 0; l < NODES; l++) {
        if (k + l > 2) discarded += norm(k, l);
        else if (k + l > 0) kept += norm(k, l);
      }
    }
    error[axis] = discarded + geometricTail(norm) + byHeight[axis];
    reach[axis] = kept + error[axis] + MARGIN;
  }
  const range = {
    minColumn: coefficients[0] - reach[0],
    maxColumn: coefficients[0] + reach[0],
    minRow: coefficients[1] - reach[1],
    maxRow: coefficients[1] + reach[1],
  };
  return { range, terms, errorColumn: error[0], errorRow: error[1], cosLatitude };
}

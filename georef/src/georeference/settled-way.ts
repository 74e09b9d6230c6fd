import type { Bounds, GridWindow } from "../grid/window.js";
import { along, choiceOf } from "../transformation/choice.js";
import { type GridStep, linkOf, linksOf } from "../transformation/compile.js";
import type { Link } from "../transformation/link.js";
import type { Transformation, Way } from "../transformation/step.js";
import type { Box } from "./expansion.js";

/** Points along each side of a node, and its heights. */
const SIDE = 9;
const HEIGHTS = [-1, 0, 1];
/** Between the points of the raster what is looked at bends by less than this share of its extent. */
const MARGIN = 0.02;
/** Radians; half a millimetre, so that a node without width has some. */
const LEAST = 1e-10;
const TURN = 2 * Math.PI;

/**
 * The transformation of a node whose points all go one way of a choice; the transformation itself where there is none to
 * make.
 *
 * @returns nothing where not all of its points go the same way, or that cannot be told
 */
export function settledWay(transformation: Transformation, box: Box): Transformation | undefined {
  const choice = choiceOf(transformation);
  if (!choice) return transformation;
  const start = raster(box);
  applyAll(linksOf({ steps: transformation.steps.slice(0, 1) })[0], start);
  for (const way of choice.ways) {
    const covered = coveredBy(way, box, start);
    if (covered === "whole") return along(transformation, way);
    if (covered === "in part") return undefined;
  }
  return undefined;
}

/** What of a node goes a way, as far as ways before it do not have it. @param start behind the projection */
function coveredBy({ area, steps }: Way, { x, y, halfX, halfY }: Box, start: Float64Array): Covered {
  const there = { west: x - halfX, south: y - halfY, east: x + halfX, north: y + halfY };
  const { minX, minY, maxX, maxY } = area;
  const meant = covered(there, { west: minX, south: minY, east: maxX, north: maxY });
  if (meant !== "whole") return meant;
  const states = start.slice();
  for (const step of steps) {
    if (step.kind === "horizontalShift" || step.kind === "verticalShift") {
      const bounds = boundsOf(states);
      if (!bounds) return "in part";
      const held = boundsOfWindow(step.window);
      const within = covered(widened(turnedTo(held, bounds), reachOf(step)), held);
      if (within !== "whole") return within;
    }
    applyAll(linkOf(step), states);
    if (!states.every(Number.isFinite)) return "in part";
  }
  return "whole";
}

type Covered = "whole" | "in part" | "nothing";

/** What of the bounds lies in others. */
function covered(bounds: Bounds, within: Bounds): Covered {
  const { west, south, east, north } = bounds;
  if (north < within.south || south > within.north || east < within.west || west > within.east)
    return "nothing";
  const inside = south >= within.south && north <= within.north && west >= within.west && east <= within.east;
  return inside ? "whole" : "in part";
}

/** Bounds on the turn nearest to others. */
function turnedTo(others: Bounds, bounds: Bounds): Bounds {
  const turn = TURN * Math.round((others.west + others.east - bounds.west - bounds.east) / 2 / TURN);
  return { ...bounds, west: bounds.west + turn, east: bounds.east + turn };
}

/** How far from a point (radians) its grid is looked up: at the solution of an inverse shift. */
function reachOf(step: GridStep): number {
  if (step.kind === "verticalShift" || step.direction === "forward") return 0;
  const { values, unit, columns, rows } = step.window;
  let greatest = 0;
  for (let i = 0; i < 2 * columns * rows; i++) {
    const value = Math.abs(values[i]) * unit;
    // Nodes without data may hold any number.
    if (value > greatest && value < 1) greatest = value;
  }
  return greatest;
}

function boundsOfWindow({ west, south, stepLongitude, stepLatitude, columns, rows }: GridWindow): Bounds {
  return {
    ...{ west, south },
    east: west + (columns - 1) * stepLongitude,
    north: south + (rows - 1) * stepLatitude,
  };
}

/** Bounds of the states, and a margin; nothing where they have none, or longitude jumps among them. */
function boundsOf(states: Float64Array): Bounds | undefined {
  let [west, south, east, north] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < states.length; i += 3) {
    if (!Number.isFinite(states[i] + states[i + 1])) return undefined;
    west = Math.min(west, states[i]);
    east = Math.max(east, states[i]);
    south = Math.min(south, states[i + 1]);
    north = Math.max(north, states[i + 1]);
  }
  if (east - west > Math.PI / 2) return undefined;
  return widened({ west, south, east, north }, MARGIN * Math.max(east - west, north - south) + LEAST);
}

function widened({ west, south, east, north }: Bounds, by: number): Bounds {
  return { west: west - by, south: south - by, east: east + by, north: north + by };
}

function raster({ x, y, z, halfX, halfY, halfZ }: Box): Float64Array {
  const states = new Float64Array(3 * SIDE * SIDE * HEIGHTS.length);
  const share = (i: number) => (2 * i) / (SIDE - 1) - 1;
  let at = 0;
  for (const height of HEIGHTS) {
    for (let i = 0; i < SIDE; i++) {
      for (let j = 0; j < SIDE; j++) {
        states.set([x + share(i) * halfX, y + share(j) * halfY, z + height * halfZ], at);
        at += 3;
      }
    }
  }
  return states;
}

function applyAll(link: Link, states: Float64Array): void {
  const state = new Float64Array(3);
  for (let at = 0; at < states.length; at += 3) {
    state.set(states.subarray(at, at + 3));
    link.apply(state);
    states.set(state, at);
  }
}

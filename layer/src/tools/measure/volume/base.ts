import { fitPlane } from "@groma/georef";
import { MeasureError } from "../../../errors/index.js";
import { Tin } from "./tin.js";

/**
 * What a surface is held against.
 * - `height`: a level; `lowest`, `highest`: that of the ring's lowest or highest vertex
 * - `plane`: the plane that fits the ring's vertices best
 * - `ring`: triangles between the ring's vertices
 * - `surface`: triangles between other points
 */
export type VolumeBase =
  | { readonly kind: "height"; readonly height: number }
  | { readonly kind: "lowest" | "highest" | "plane" }
  | { readonly kind: "ring" }
  | { readonly kind: "surface"; readonly points: Float64Array };

/** Hears the share of a work that is done, 0 to 1. */
export type Progress = (share: number) => void;

/** A surface as it is held against a base. */
export interface Held {
  /** x, y and height above the base of each place. */
  readonly above: Float64Array;
  /** The two surfaces, where the base is one too; of one surface alone, `above` has its points in their order. */
  readonly surfaces?: readonly [surface: Tin, base: Tin] | undefined;
}

/** @throws MeasureError MEASURE_SURFACE where the base has no height over a place, or there are no two surfaces */
export function heldAgainst(
  points: Float64Array,
  ring: Float64Array,
  base: VolumeBase,
  onProgress: Progress,
): Held {
  if (base.kind === "ring") return between(points, ring, onProgress);
  if (base.kind === "surface") return between(points, base.points, onProgress);
  const level = levelOf(ring, base);
  const above = Float64Array.from(points);
  for (let i = 0; i < above.length; i += 3) above[i + 2] -= level(above[i], above[i + 1]);
  return { above };
}

/** The error for points that make no surface. */
export function noSurface(): MeasureError {
  return new MeasureError({
    code: "MEASURE_SURFACE",
    file: "volume",
    cause: "there are not three points that make a surface in the ring",
    fix: "draw the ring around more points, or take in more classes of them",
  });
}

function levelOf(
  ring: Float64Array,
  base: Exclude<VolumeBase, { kind: "ring" | "surface" }>,
): (x: number, y: number) => number {
  const heights = Array.from({ length: ring.length / 3 }, (_, i) => ring[3 * i + 2]);
  switch (base.kind) {
    case "height":
      return () => base.height;
    case "lowest":
    case "highest": {
      const level = base.kind === "lowest" ? Math.min(...heights) : Math.max(...heights);
      return () => level;
    }
    case "plane": {
      const { centre, normal } = fitPlane(ring);
      // A plane on edge has no height over a place.
      if (Math.abs(normal[2]) < 1e-6) throw noSurface();
      return (x, y) => centre[2] - (normal[0] * (x - centre[0]) + normal[1] * (y - centre[1])) / normal[2];
    }
  }
}

/** Differences of two surfaces at the points of both; places that only one of them covers are left out. */
function between(points: Float64Array, others: Float64Array, onProgress: Progress): Held {
  const surface = new Tin(points);
  onProgress(0.35);
  const base = new Tin(others);
  onProgress(0.7);
  if (surface.triangles.length === 0 || base.triangles.length === 0) throw noSurface();
  // The same points lie in the same surface, whatever rounding has of it.
  const same = points.length === others.length && points.every((value, i) => value === others[i]);
  const above = new Float64Array(points.length + others.length);
  let count = 0;
  const add = (x: number, y: number, difference: number) => {
    if (Number.isNaN(difference)) return;
    above[3 * count] = x;
    above[3 * count + 1] = y;
    above[3 * count + 2] = same ? 0 : difference;
    count++;
  };
  // Of several points in one place the one counts that its surface goes through.
  const [ofSurface, ofBase] = [surface.corners(), base.corners()];
  for (const at of inOrder(points)) {
    const [x, y, z] = [points[at], points[at + 1], points[at + 2]];
    if (ofSurface[at / 3]) add(x, y, z - base.heightAt(x, y));
  }
  onProgress(0.85);
  for (const at of inOrder(others)) {
    const [x, y, z] = [others[at], others[at + 1], others[at + 2]];
    if (ofBase[at / 3]) add(x, y, surface.heightAt(x, y) - z);
  }
  return { above: above.subarray(0, 3 * count), surfaces: [surface, base] };
}

/** Cells of the plan, row by row to and fro, so that each place is near the one before. @returns offsets of x */
function inOrder(points: Float64Array): Uint32Array {
  const count = points.length / 3;
  let [west, south, east, north] = [Infinity, Infinity, -Infinity, -Infinity];
  for (let at = 0; at < points.length; at += 3) {
    west = Math.min(west, points[at]);
    east = Math.max(east, points[at]);
    south = Math.min(south, points[at + 1]);
    north = Math.max(north, points[at + 1]);
  }
  const side = Math.max(1, Math.ceil(Math.sqrt(count / 2)));
  const perX = side / (east - west || 1);
  const perY = side / (north - south || 1);
  const cells = new Uint32Array(count);
  const starts = new Uint32Array(side * side + 1);
  for (let i = 0, at = 0; i < count; i++, at += 3) {
    const row = Math.min(side - 1, Math.floor((points[at + 1] - south) * perY));
    const column = Math.min(side - 1, Math.floor((points[at] - west) * perX));
    const cell = row * side + (row % 2 === 0 ? column : side - 1 - column);
    cells[i] = cell;
    starts[cell + 1]++;
  }
  for (let cell = 0; cell < side * side; cell++) starts[cell + 1] += starts[cell];
  const offsets = new Uint32Array(count);
  for (let i = 0; i < count; i++) offsets[starts[cells[i]]++] = 3 * i;
  return offsets;
}

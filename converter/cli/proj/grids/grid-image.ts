import type { Bounds, Grid } from "@groma/georef";
import { ProjError } from "../program/errors.js";

/** Where the nodes of a grid stand: radians, south-western node, steps to the east and north. */
export interface Lattice {
  readonly west: number;
  readonly south: number;
  readonly stepLongitude: number;
  readonly stepLatitude: number;
  readonly columns: number;
  readonly rows: number;
}

/**
 * One grid of a file. Channels: longitude (east) and latitude shifts, or the one of a vertical grid.
 */
export interface GridImage extends Lattice {
  /** Its name inside of the file, where it has one. */
  readonly name: string;
  /** Finer grids that take its place where they lie. */
  readonly children: GridImage[];
  /** Reads at least the nodes that {@link Bounds} need; others may come as NaN. */
  load(bounds: Bounds): Promise<Grid>;
}

/** What a grid is read for. */
export type GridKind = "horizontal" | "vertical";

/**
 * A finer grid hangs below the one it names as its parent, else below the one that holds it, as in PROJ.
 *
 * @returns the outermost grids in the order of the file
 */
export function nest(images: readonly (GridImage & { readonly parent?: string | undefined })[]): GridImage[] {
  const roots: GridImage[] = [];
  for (const [i, image] of images.entries()) {
    const before = images.slice(0, i);
    const named = image.parent && before.find(({ name }) => name === image.parent);
    const parent = named || smallestHolder(roots, image);
    if (parent) parent.children.push(image);
    else roots.push(image);
  }
  return roots;
}

function smallestHolder(images: readonly GridImage[], image: Lattice): GridImage | undefined {
  for (const candidate of images) {
    if (holds(candidate, boundsOf(image))) return smallestHolder(candidate.children, image) ?? candidate;
  }
  return undefined;
}

/** Bounds of the nodes of a grid, radians. */
export function boundsOf({ west, south, stepLongitude, stepLatitude, columns, rows }: Lattice): Bounds {
  return {
    west,
    south,
    east: west + (columns - 1) * stepLongitude,
    north: south + (rows - 1) * stepLatitude,
  };
}

/** Whether a grid goes round the earth, its last column next to its first. */
export function goesRound({ stepLongitude, columns }: Lattice): boolean {
  return Math.round((2 * Math.PI) / stepLongitude) <= columns;
}

/** PROJ takes a point for inside as far as this share of a cell beyond the edge. */
const FORGIVEN = 1e-4;

/** The bounds on the turn that brings them nearest to the grid. */
export function turned(grid: Lattice, bounds: Bounds): Bounds {
  const own = boundsOf(grid);
  const apart = (bounds.west + bounds.east - own.west - own.east) / 2;
  const turn = 2 * Math.PI * Math.round(apart / (2 * Math.PI));
  return { ...bounds, west: bounds.west - turn, east: bounds.east - turn };
}

/** Whether the bounds lie in the grid altogether. */
export function holds(grid: Lattice, bounds: Bounds): boolean {
  const own = boundsOf(grid);
  const { west, east, south, north } = turned(grid, bounds);
  const [x, y] = [FORGIVEN * grid.stepLongitude, FORGIVEN * grid.stepLatitude];
  const across = goesRound(grid) || (west >= own.west - x && east <= own.east + x);
  return across && south >= own.south - y && north <= own.north + y;
}

/** Whether the bounds touch the grid. */
export function touches(grid: Lattice, bounds: Bounds): boolean {
  const own = boundsOf(grid);
  const { west, east, south, north } = turned(grid, bounds);
  return (
    (goesRound(grid) || (west <= own.east && east >= own.west)) && south <= own.north && north >= own.south
  );
}

/** A grid file that cannot be read; `cause` is a clause without a closing stop. */
export function unreadable(file: string, cause: string): ProjError {
  return new ProjError({
    code: "PROJ_GRID",
    file,
    cause,
    fix: "get the grid anew, with projsync or from https://cdn.proj.org",
  });
}

/** A lattice that can be one: finite, with steps towards east and north, and not too large to be one. */
export function checkedLattice(file: string, lattice: Lattice): Lattice {
  const { west, south, stepLongitude, stepLatitude, columns, rows } = lattice;
  const finite = [west, south, stepLongitude, stepLatitude].every(Number.isFinite);
  const counted = [columns, rows].every((count) => Number.isInteger(count) && count >= 2 && count <= 1e6);
  if (!finite || !counted || stepLongitude <= 0 || stepLatitude <= 0) {
    throw unreadable(file, "its nodes do not form a grid of longitude and latitude");
  }
  return lattice;
}

import type { Bounds, Grid } from "@groma/georef";
import { unreadable } from "./grid-image.js";

/** A finer grid and the area where it counts. */
export interface Part {
  readonly area: Bounds;
  readonly grid: Grid;
}

/** How far from a whole number the ratio of two steps may be. */
const ALIKE = 1e-6;

/**
 * One grid in the finest of all steps: inside of a part its nodes, elsewhere the coarse grid interpolated, which
 * changes nothing, since a bilinear cell cut in equal parts stays the same surface. Only in the cells along the
 * edge of a part does it differ from PROJ, by as much as the two grids disagree there.
 *
 * @throws ProjError PROJ_GRID when the steps of the grids are no multiples of each other
 */
export function composite(coarse: Grid, parts: readonly Part[]): Grid {
  const east = Math.max(...parts.map(({ grid }) => Math.round(coarse.stepLongitude / grid.stepLongitude)));
  const north = Math.max(...parts.map(({ grid }) => Math.round(coarse.stepLatitude / grid.stepLatitude)));
  const stepLongitude = coarse.stepLongitude / east;
  const stepLatitude = coarse.stepLatitude / north;
  for (const { grid } of parts) {
    const aligned =
      whole(grid.stepLongitude / stepLongitude) &&
      whole(grid.stepLatitude / stepLatitude) &&
      whole((grid.west - coarse.west) / stepLongitude) &&
      whole((grid.south - coarse.south) / stepLatitude) &&
      grid.unit === coarse.unit;
    if (!aligned) throw unreadable(coarse.grid, "its finer grids do not fit into the coarser ones");
  }
  return {
    ...coarse,
    stepLongitude,
    stepLatitude,
    columns: (coarse.columns - 1) * east + 1,
    rows: (coarse.rows - 1) * north + 1,
    value(channel, row, column) {
      const longitude = coarse.west + column * stepLongitude;
      const latitude = coarse.south + row * stepLatitude;
      const inside = parts.find(({ area }) =>
        contains(area, longitude, latitude, stepLongitude, stepLatitude),
      );
      return interpolated(inside?.grid ?? coarse, channel, longitude, latitude);
    },
  };
}

function whole(ratio: number): boolean {
  return Math.abs(ratio - Math.round(ratio)) < ALIKE * Math.max(1, Math.abs(ratio));
}

function contains(area: Bounds, longitude: number, latitude: number, stepX: number, stepY: number): boolean {
  const [x, y] = [stepX * ALIKE, stepY * ALIKE];
  return (
    longitude >= area.west - x &&
    longitude <= area.east + x &&
    latitude >= area.south - y &&
    latitude <= area.north + y
  );
}

/** Bilinear, exactly the node's value on a node. */
function interpolated(grid: Grid, channel: number, longitude: number, latitude: number): number {
  const [column, u] = cell((longitude - grid.west) / grid.stepLongitude, grid.columns);
  const [row, v] = cell((latitude - grid.south) / grid.stepLatitude, grid.rows);
  const node = (i: number, j: number) => grid.value(channel, row + j, column + i);
  const [southWest, southEast] = [node(0, 0), u > 0 ? node(1, 0) : 0];
  const [northWest, northEast] = [v > 0 ? node(0, 1) : 0, u > 0 && v > 0 ? node(1, 1) : 0];
  for (const value of [southWest, southEast, northWest, northEast]) {
    if (Number.isNaN(value) || value === grid.noData) return grid.noData ?? Number.NaN;
  }
  const south = southWest * (1 - u) + southEast * u;
  const north = northWest * (1 - u) + northEast * u;
  return Math.fround(south * (1 - v) + north * v);
}

/** The cell that a position in cells lies in, and how far into it. */
function cell(position: number, count: number): [index: number, share: number] {
  const nearest = Math.round(position);
  if (Math.abs(position - nearest) < ALIKE) return [Math.max(0, Math.min(count - 1, nearest)), 0];
  const index = Math.max(0, Math.min(count - 2, Math.floor(position)));
  return [index, position - index];
}

import { PlacementError } from "../errors/errors.js";

/**
 * A rectangular part of a grid with its margin. Node (column, row) stands at
 * (west + column · stepLongitude, south + row · stepLatitude), rows from the south, columns from the west.
 */
export interface GridWindow {
  /** File name of the grid it was cut from, for people. */
  readonly grid: string;
  /** Radians. */
  readonly west: number;
  readonly south: number;
  readonly stepLongitude: number;
  readonly stepLatitude: number;
  readonly columns: number;
  readonly rows: number;
  readonly channels: number;
  /**
   * float32 as the grid file has them, channel by channel and row by row:
   * `values[(channel · rows + row) · columns + column]`, in units of `unit`.
   */
  readonly values: Float32Array;
  /**
   * What one unit of `values` is in radians (horizontal) or metres (vertical); kept apart so that values stay exact.
   * The product is rounded to float32, as PROJ does.
   */
  readonly unit: number;
  /**
   * Nodes of this value hold no data, as those that are not finite; PROJ leaves them out of the interpolation
   * (vertical) or refuses the point (horizontal).
   */
  readonly noData?: number;
}

/**
 * A whole grid as a file has it, told so that no reader needs to hold more than it wants. Nodes stand as in
 * {@link GridWindow}: row 0 in the south, column 0 in the west, channel 0 east and 1 north for shifts.
 */
export interface Grid extends Omit<GridWindow, "values"> {
  /** float32 value of a node, in units of `unit`. */
  value(channel: number, row: number, column: number): number;
}

/** Geodetic bounds, radians. `west` may exceed `east`, or both lie beyond ±π, where the antimeridian is inside. */
export interface Bounds {
  readonly west: number;
  readonly south: number;
  readonly east: number;
  readonly north: number;
}

const TURN = 2 * Math.PI;

/**
 * The part of a grid that the bounds need: every cell that they touch, and one more node on each side for points
 * that a shift moves across. Cut off where the grid ends; a grid that goes round the earth is followed across its seam.
 *
 * @throws PlacementError PLACE_DOMAIN when no cell of the grid lies within the bounds
 */
export function cutWindow(grid: Grid, bounds: Bounds): GridWindow {
  const { stepLongitude, stepLatitude, channels } = grid;
  const global = Math.round(TURN / stepLongitude) <= grid.columns;
  const east = bounds.east < bounds.west ? bounds.east + TURN : bounds.east;
  // The turn that brings the middle of the bounds nearest to the middle of the grid.
  const middle = grid.west + ((grid.columns - 1) * stepLongitude) / 2;
  const turns = TURN * Math.round(((bounds.west + east) / 2 - middle) / TURN);

  const columns = cells(
    (bounds.west - turns - grid.west) / stepLongitude,
    (east - turns - grid.west) / stepLongitude,
  );
  const rows = cells((bounds.south - grid.south) / stepLatitude, (bounds.north - grid.south) / stepLatitude);
  const [firstColumn, lastColumn] = global ? columns : clip(columns, grid.columns);
  const [firstRow, lastRow] = clip(rows, grid.rows);
  if (!(lastColumn > firstColumn && lastRow > firstRow)) throw outside(grid, bounds);

  const width = lastColumn - firstColumn + 1;
  const height = lastRow - firstRow + 1;
  const values = new Float32Array(channels * width * height);
  // The last column of a global grid may repeat the first; a turn is what counts.
  const around = global ? Math.round(TURN / stepLongitude) : grid.columns;
  let at = 0;
  for (let channel = 0; channel < channels; channel++) {
    for (let row = firstRow; row <= lastRow; row++) {
      for (let column = firstColumn; column <= lastColumn; column++) {
        values[at++] = grid.value(channel, row, ((column % around) + around) % around);
      }
    }
  }
  return {
    grid: grid.grid,
    west: grid.west + firstColumn * stepLongitude,
    south: grid.south + firstRow * stepLatitude,
    stepLongitude,
    stepLatitude,
    columns: width,
    rows: height,
    channels,
    values,
    unit: grid.unit,
    ...(grid.noData === undefined ? {} : { noData: grid.noData }),
  };
}

/** First and last node of the cells between two positions in cells, and one more node on each side. */
function cells(from: number, to: number): [first: number, last: number] {
  return [Math.floor(from) - 1, Math.floor(to) + 2];
}

function clip([first, last]: [number, number], count: number): [number, number] {
  return [Math.max(0, first), Math.min(count - 1, last)];
}

function outside(grid: Grid, { west, south, east, north }: Bounds): PlacementError {
  const degrees = (radians: number) => ((radians * 180) / Math.PI).toFixed(4);
  return new PlacementError({
    code: "PLACE_DOMAIN",
    file: grid.grid,
    cause: `the grid does not cover longitude ${degrees(west)}° … ${degrees(east)}°, latitude ${degrees(south)}° … ${degrees(north)}°`,
    fix: "check that the coordinate reference system is the one the scan was made in",
  });
}

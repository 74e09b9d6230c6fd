import { MARGIN, SIZE } from "./area.js";
import { type Building, roofHeightAt } from "./buildings.js";
import { SUN } from "./ray.js";
import type { Terrain } from "./terrain.js";
import { crownTopAt, type Tree } from "./trees.js";

/** Share of the sun that reaches a place at a height: 0 in full shade, 1 in full sun. */
export type Light = (x: number, y: number, z: number) => number;

const CELLS = SIZE + 2 * MARGIN;

/**
 * Shadows as an aerial photograph has them: for each one-metre cell the height up to which the sun is hidden.
 * One sweep away from the sun: a cell is shaded up to what stands one row nearer, less the fall of the ray.
 */
export function createLight(terrain: Terrain, buildings: readonly Building[], trees: readonly Tree[]): Light {
  const surface = new Float32Array(CELLS * CELLS);
  for (let row = 0; row < CELLS; row++) {
    for (let column = 0; column < CELLS; column++) {
      surface[row * CELLS + column] = terrain.heightAt(column - MARGIN, row - MARGIN);
    }
  }
  for (const building of buildings) raise(surface, building, building.halfLength + 1, roofHeightAt);
  for (const tree of trees) raise(surface, tree, tree.radius, crownTopAt);

  const shade = new Float32Array(CELLS * CELLS).fill(-Infinity);
  // The sun stands in the south-east: rows are swept from the south, each ray coming from the row before.
  const shift = -SUN.x / SUN.y;
  const fall = SUN.z / -SUN.y;
  for (let row = 1; row < CELLS; row++) {
    for (let column = 0; column < CELLS; column++) {
      const from = Math.min(CELLS - 1.001, column + shift);
      const west = Math.floor(from);
      const share = from - west;
      const at = (row - 1) * CELLS + west;
      const left = Math.max(surface[at], shade[at]);
      const right = Math.max(surface[at + 1], shade[at + 1]);
      shade[row * CELLS + column] = left + share * (right - left) - fall;
    }
  }
  return (x, y, z) => {
    const column = Math.min(CELLS - 1, Math.max(0, Math.round(x + MARGIN)));
    const row = Math.min(CELLS - 1, Math.max(0, Math.round(y + MARGIN)));
    const above = z - shade[row * CELLS + column];
    return Math.min(1, Math.max(0, above / 0.8 + 0.75));
  };
}

function raise<T extends { x: number; y: number }>(
  surface: Float32Array,
  thing: T,
  reach: number,
  heightAt: (thing: T, x: number, y: number) => number,
): void {
  const [west, south] = [Math.floor(thing.x - reach), Math.floor(thing.y - reach)];
  for (let y = south; y <= thing.y + reach; y++) {
    for (let x = west; x <= thing.x + reach; x++) {
      if (x < -MARGIN || y < -MARGIN || x >= SIZE + MARGIN || y >= SIZE + MARGIN) continue;
      const at = (y + MARGIN) * CELLS + x + MARGIN;
      surface[at] = Math.max(surface[at], heightAt(thing, x, y));
    }
  }
}

import { floorHeight, MARGIN, SIZE, smoothstep } from "./area.js";
import { createFractalNoise, type Random } from "./random.js";
import { carveRiver } from "./river.js";
import { layRoad } from "./road.js";

/** The bare ground as a raster of one-metre cells, read bilinearly. */
export interface Terrain {
  /** Height at a place, metres; places beyond the margin take the nearest edge. */
  heightAt(x: number, y: number): number;
  /** Steepness: length of the gradient, metres per metre. */
  slopeAt(x: number, y: number): number;
  /** Unit normal, written into `out` as x, y, z. */
  normalAt(x: number, y: number, out: Float64Array): void;
  /** Highest ground of all. */
  readonly top: number;
}

const CELLS = SIZE + 2 * MARGIN;
const CLIFF_X = 88;
const CLIFF_WIDTH = 34;
const CLIFF_HEIGHT = 118;
const EAST_FOOT = 396;

/**
 * A glacial trough: a rock face with scree at its foot in the west, a flat floor with river and road, a wooded
 * slope in the east.
 */
export function createTerrain(random: Random): Terrain {
  const broad = createFractalNoise(random, 150, 3);
  const rough = createFractalNoise(random, 22, 4);
  const edges = createFractalNoise(random, 90, 3);

  const rawHeight = (x: number, y: number): number => {
    const cliff = CLIFF_X + 20 * edges(y, 0) + 5 * rough(x * 0.3, y);
    const west = cliff - x;
    const east = x - (EAST_FOOT + 24 * edges(500, y));
    const wild = Math.max(smoothstep(-75, 0, west), smoothstep(0, 50, east));
    let height = floorHeight(y) + (0.5 + 2.5 * wild) * broad(x, y) + (0.12 + 1.9 * wild) * rough(x, y);
    const scree = smoothstep(-85, -5, west);
    height += 21 * scree * Math.sqrt(scree);
    height += CLIFF_HEIGHT * smoothstep(0, CLIFF_WIDTH, west) + 0.45 * Math.max(0, west - CLIFF_WIDTH);
    if (east > 0) height += east < 110 ? (east * east) / 260 : 46.5 + 0.85 * (east - 110);
    return layRoad(carveRiver(height, x, y), x, y);
  };

  const heights = new Float32Array(CELLS * CELLS);
  let top = -Infinity;
  for (let row = 0; row < CELLS; row++) {
    for (let column = 0; column < CELLS; column++) {
      const height = rawHeight(column - MARGIN, row - MARGIN);
      heights[row * CELLS + column] = height;
      if (height > top) top = height;
    }
  }

  const heightAt = (x: number, y: number): number => {
    const u = Math.min(CELLS - 1.001, Math.max(0, x + MARGIN));
    const v = Math.min(CELLS - 1.001, Math.max(0, y + MARGIN));
    const column = Math.floor(u);
    const row = Math.floor(v);
    const at = row * CELLS + column;
    const fu = u - column;
    const fv = v - row;
    const south = heights[at] + fu * (heights[at + 1] - heights[at]);
    const north = heights[at + CELLS] + fu * (heights[at + CELLS + 1] - heights[at + CELLS]);
    return south + fv * (north - south);
  };
  const normalAt = (x: number, y: number, out: Float64Array): void => {
    const dx = (heightAt(x + 1, y) - heightAt(x - 1, y)) / 2;
    const dy = (heightAt(x, y + 1) - heightAt(x, y - 1)) / 2;
    const length = Math.sqrt(dx * dx + dy * dy + 1);
    out[0] = -dx / length;
    out[1] = -dy / length;
    out[2] = 1 / length;
  };
  const slopeAt = (x: number, y: number): number =>
    Math.hypot(heightAt(x + 1, y) - heightAt(x - 1, y), heightAt(x, y + 1) - heightAt(x, y - 1)) / 2;
  return { heightAt, slopeAt, normalAt, top };
}

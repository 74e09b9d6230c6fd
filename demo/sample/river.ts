import { floorHeight, smoothstep } from "./area.js";

/** Half the width of the water, metres. */
export const RIVER_HALF_WIDTH = 6.5;
const BANK = 7;
const WATER_BELOW_FLOOR = 2.2;

/** Easting of the river's centre line at northing y, local metres. */
function riverX(y: number): number {
  return 240 + 24 * Math.sin(y / 92) + 8 * Math.sin(y / 41 + 1);
}

/** Distance from the river's centre line, metres (square to the line to first order). */
export function riverDistance(x: number, y: number): number {
  const slope = (24 / 92) * Math.cos(y / 92) + (8 / 41) * Math.cos(y / 41 + 1);
  return Math.abs(x - riverX(y)) / Math.sqrt(1 + slope * slope);
}

/** Ground height with the bed of the river cut into it; the surface of the water is what a laser sees. */
export function carveRiver(ground: number, x: number, y: number): number {
  const distance = riverDistance(x, y);
  if (distance > RIVER_HALF_WIDTH + BANK) return ground;
  const water = floorHeight(y) - WATER_BELOW_FLOOR;
  return water + (ground - water) * smoothstep(RIVER_HALF_WIDTH - 0.5, RIVER_HALF_WIDTH + BANK, distance);
}

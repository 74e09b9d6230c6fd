import { inside, SIZE } from "./area.js";
import { between, type Random } from "./random.js";
import { CLASS, type Echo, type Ray, sunOn } from "./ray.js";
import { riverDistance } from "./river.js";
import { laneY, pavementDistance, roadX } from "./road.js";
import type { Terrain } from "./terrain.js";

/** A house: a box with a gable roof whose ridge runs along its longer side. Metres, local frame. */
export interface Building {
  x: number;
  y: number;
  /** Direction of the ridge as a unit vector. */
  ux: number;
  uy: number;
  halfLength: number;
  halfWidth: number;
  base: number;
  eaves: number;
  ridge: number;
  wall: readonly [number, number, number];
  roof: readonly [number, number, number];
}

const OVERHANG = 0.5;
const WALLS = [
  [0.42, 0.29, 0.19],
  [0.55, 0.4, 0.26],
  [0.86, 0.83, 0.76],
  [0.7, 0.62, 0.5],
] as const;
const ROOFS = [
  [0.52, 0.27, 0.2],
  [0.46, 0.22, 0.17],
  [0.36, 0.33, 0.32],
  [0.58, 0.34, 0.25],
] as const;
const PICK = <T>(random: Random, of: readonly T[]): T => of[Math.floor(random() * of.length)];

/** Houses along the road and the lane, and a church with a tower where the two meet. */
export function createBuildings(random: Random, terrain: Terrain): Building[] {
  const buildings: Building[] = [];
  const free = (x: number, y: number, radius: number): boolean =>
    inside(x, y) &&
    pavementDistance(x, y) > radius + 1.5 &&
    riverDistance(x, y) > radius + 14 &&
    terrain.slopeAt(x, y) < 0.35 &&
    buildings.every((other) => Math.hypot(x - other.x, y - other.y) > radius + other.halfLength + 5);
  const build = (
    x: number,
    y: number,
    heading: number,
    size: readonly [number, number, number, number],
  ): void => {
    const [halfLength, halfWidth, wallHeight, roofHeight] = size;
    const base = terrain.heightAt(x, y) - 0.6;
    const eaves = base + 0.6 + wallHeight;
    const wall = PICK(random, WALLS);
    const roof = PICK(random, ROOFS);
    const [ux, uy] = [Math.sin(heading), Math.cos(heading)];
    buildings.push({
      x,
      y,
      ux,
      uy,
      halfLength,
      halfWidth,
      base,
      eaves,
      ridge: eaves + roofHeight,
      wall,
      roof,
    });
  };
  const house = (x: number, y: number, heading: number): void => {
    const halfWidth = between(random, 4, 5.8);
    const halfLength = halfWidth * between(random, 1.1, 1.6);
    const wallHeight = between(random, 4.2, 7.5);
    if (free(x, y, halfWidth)) build(x, y, heading, [halfLength, halfWidth, wallHeight, halfWidth * 0.55]);
  };

  const church = { x: roadX(292) + 27, y: 292 };
  build(church.x, church.y, Math.PI / 2, [13, 6, 8, 6.5]);
  build(church.x - 17.6, church.y, Math.PI / 2, [3.2, 3.1, 19, 9]);
  for (let y = 40; y < SIZE - 25; y += between(random, 15, 24)) {
    const crowd = Math.exp(-(((y - 275) / 165) ** 2));
    for (const side of [-1, 1]) {
      for (const row of [0, 1]) {
        if (random() > crowd * (row ? 0.5 : 0.85)) continue;
        const away = side * between(random, 13, 19) * (row ? 2.4 : 1);
        house(roadX(y) + away, y + between(random, -3, 3), between(random, -0.25, 0.25) + (row ? 1.4 : 0));
      }
    }
  }
  for (let x = 150; x < 302; x += between(random, 17, 26)) {
    for (const side of [-1, 1]) {
      if (random() > 0.8) continue;
      house(x, laneY(x) + side * between(random, 13, 19), Math.PI / 2 + between(random, -0.3, 0.3));
    }
  }
  return buildings;
}

/** Height of the roof over a place, or -Infinity beside the house. */
export function roofHeightAt(building: Building, x: number, y: number): number {
  const dx = x - building.x;
  const dy = y - building.y;
  const along = Math.abs(dx * building.ux + dy * building.uy);
  const across = Math.abs(dx * building.uy - dy * building.ux);
  if (along > building.halfLength + OVERHANG || across > building.halfWidth + OVERHANG) return -Infinity;
  return building.ridge - ((building.ridge - building.eaves) * across) / building.halfWidth;
}

/**
 * First meeting of a pulse with roof or wall, at `range` below `limit`; fills `echo` and says whether it hit.
 * The house's own frame has u along the ridge and v across it.
 */
export function hitBuilding(building: Building, ray: Ray, limit: number, echo: Echo): boolean {
  const { ux, uy, halfLength, halfWidth, ridge } = building;
  const x = ray.x - building.x;
  const y = ray.y - building.y;
  const u0 = x * ux + y * uy;
  const v0 = x * uy - y * ux;
  const du = ray.dx * ux + ray.dy * uy;
  const dv = ray.dx * uy - ray.dy * ux;
  const pitch = (ridge - building.eaves) / halfWidth;
  let best = limit;
  let roofSide = 0;
  for (const side of [-1, 1]) {
    const t = (ridge - ray.z - pitch * side * v0) / (ray.dz + pitch * side * dv);
    const v = side * (v0 + t * dv);
    if (t < best && v >= 0 && v <= halfWidth + OVERHANG && Math.abs(u0 + t * du) <= halfLength + OVERHANG) {
      best = t;
      roofSide = side;
    }
  }
  let wallU = 0;
  let wallV = 0;
  for (const side of [-1, 1]) {
    const tu = (side * halfLength - u0) / du;
    const v = Math.abs(v0 + tu * dv);
    if (tu < best && side * du < 0 && v <= halfWidth && ray.z + tu * ray.dz < ridge - pitch * v) {
      [best, roofSide, wallU, wallV] = [tu, 0, side, 0];
    }
    const tv = (side * halfWidth - v0) / dv;
    if (
      tv < best &&
      side * dv < 0 &&
      Math.abs(u0 + tv * du) <= halfLength &&
      ray.z + tv * ray.dz < building.eaves
    ) {
      [best, roofSide, wallU, wallV] = [tv, 0, 0, side];
    }
  }
  if (best >= limit || ray.z + best * ray.dz < building.base) return false;
  const height = ray.z + best * ray.dz;
  const paint = roofSide ? building.roof : height < building.base + 2.4 ? STONE : building.wall;
  const up = roofSide ? 1 / Math.hypot(1, pitch) : 0;
  const outU = wallU;
  const outV = roofSide ? roofSide * pitch * up : wallV;
  echo.range = best;
  echo.classification = CLASS.building;
  echo.reflectance = roofSide ? 0.35 : 0.5;
  [echo.red, echo.green, echo.blue] = paint;
  echo.sunlit = sunOn(outU * ux + outV * uy, outU * uy - outV * ux, up);
  echo.solid = true;
  return true;
}

const STONE = [0.78, 0.76, 0.72] as const;

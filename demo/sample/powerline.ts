import { SIZE } from "./area.js";
import type { Random } from "./random.js";
import { CLASS, type Echo, type Ray } from "./ray.js";
import type { Terrain } from "./terrain.js";

/** A lattice tower with three pairs of arms; metres, local frame. */
export interface Tower {
  x: number;
  y: number;
  ground: number;
}

/** A conductor between two towers, hanging as a parabola. Offsets are square to the line, in metres. */
export interface Wire {
  from: Tower;
  to: Tower;
  offset: number;
  height: number;
}

export const TOWER_HEIGHT = 33;
const SAG = 5.2;
const FOOTPRINT = 0.28;
const ARMS = [
  { height: 21, reach: 5.4 },
  { height: 25, reach: 6.6 },
  { height: 29, reach: 4.6 },
] as const;
/** The line runs straight; these are its direction and the direction of the arms. */
const LENGTH = Math.hypot(0.06, 1);
const ALONG = { x: -0.06 / LENGTH, y: 1 / LENGTH };
const ACROSS = { x: ALONG.y, y: -ALONG.x };

/** Easting of the line's axis at a northing. */
export function lineX(y: number): number {
  return 380 - 0.06 * y;
}

/** Towers every 150 m, the first and last beyond the square, and seven wires in each span. */
export function createPowerLine(terrain: Terrain): { towers: Tower[]; wires: Wire[] } {
  const towers: Tower[] = [];
  for (let y = -58; y < SIZE + 150; y += 150) {
    towers.push({ x: lineX(y), y, ground: terrain.heightAt(lineX(y), y) });
  }
  const wires = towers.slice(1).flatMap((to, i) => {
    const from = towers[i];
    const pairs = ARMS.flatMap(({ height, reach }) => [
      { from, to, offset: -reach, height: height - 1.4 },
      { from, to, offset: reach, height: height - 1.4 },
    ]);
    return [...pairs, { from, to, offset: 0, height: TOWER_HEIGHT }];
  });
  return { towers, wires };
}

/** Height of a wire at a share of its span. */
function wireHeight(wire: Wire, share: number): number {
  const straight = wire.from.ground + (wire.to.ground - wire.from.ground) * share + wire.height;
  return straight - SAG * 4 * share * (1 - share);
}

/** Echo of a wire that a pulse passes within its footprint, above `limit`. */
export function hitWire(
  wire: Wire,
  ray: Ray,
  limit: number,
  random: Random,
  echo: Echo,
  add: () => void,
): void {
  const span = Math.hypot(wire.to.x - wire.from.x, wire.to.y - wire.from.y);
  let t = (wire.from.ground + wire.height - SAG - ray.z) / ray.dz;
  let share = 0;
  // The wire is nearly level, so two rounds bring the ray to its height.
  for (let round = 0; round < 2; round++) {
    const x = ray.x + t * ray.dx - wire.from.x;
    const y = ray.y + t * ray.dy - wire.from.y;
    share = (x * ALONG.x + y * ALONG.y) / span;
    t = (wireHeight(wire, share) - ray.z) / ray.dz;
  }
  if (share < 0 || share > 1 || t >= limit - 1) return;
  const offset =
    (ray.x + t * ray.dx - wire.from.x) * ACROSS.x + (ray.y + t * ray.dy - wire.from.y) * ACROSS.y;
  if (Math.abs(offset - wire.offset) > FOOTPRINT || random() < 0.15) return;
  metal(echo, t, CLASS.wire, 0.12);
  add();
}

/** Echoes of a tower's lattice: four leaning legs, bracing between them, and the arms. */
export function hitTower(
  tower: Tower,
  ray: Ray,
  limit: number,
  random: Random,
  echo: Echo,
  add: () => void,
): void {
  const enter = (tower.ground + TOWER_HEIGHT - ray.z) / ray.dz;
  for (let t = enter + 0.4 * random(); t < limit - 0.5; t += 0.4) {
    const x = ray.x + t * ray.dx - tower.x;
    const y = ray.y + t * ray.dy - tower.y;
    const height = ray.z + t * ray.dz - tower.ground;
    const along = Math.abs(x * ALONG.x + y * ALONG.y);
    const across = Math.abs(x * ACROSS.x + y * ACROSS.y);
    const half = Math.max(0.35, 2.6 * (1 - height / 26));
    const wide = Math.max(along, across);
    const leg = wide < half + 0.25 && wide > half - 0.35;
    const arm = along < 0.5 && ARMS.some((a) => Math.abs(height - a.height) < 0.45 && across < a.reach + 0.3);
    if (!(arm && random() < 0.75) && !(leg && random() < 0.22)) continue;
    metal(echo, t, CLASS.tower, 0.4);
    add();
  }
}

function metal(echo: Echo, range: number, classification: number, reflectance: number): void {
  echo.range = range;
  echo.classification = classification;
  echo.reflectance = reflectance;
  echo.red = 0.4;
  echo.green = 0.42;
  echo.blue = 0.45;
  echo.sunlit = 0.8;
  echo.solid = false;
}

import { floorHeight, inside, MARGIN, SIZE, smoothstep } from "./area.js";
import { type Building, roofHeightAt } from "./buildings.js";
import { lineX } from "./powerline.js";
import { between, createFractalNoise, type Random } from "./random.js";
import { CLASS, type Echo, type Ray } from "./ray.js";
import { riverDistance } from "./river.js";
import { pavementDistance } from "./road.js";
import type { Terrain } from "./terrain.js";

export type Crown = "conifer" | "broadleaf" | "shrub";

/** A tree or bush; metres, local frame. */
export interface Tree {
  x: number;
  y: number;
  ground: number;
  /** Height above the ground where the crown begins, and of its tip. */
  crownBase: number;
  height: number;
  radius: number;
  crown: Crown;
  paint: readonly [number, number, number];
}

const GRID = 4.6;
/** Density of foliage at the stem and at the skin of a crown, as a share of the mean. */
const THINNEST = 0.35;
const DENSEST = 1.25;
/** Free path of light in foliage, metres: what makes several echoes of one pulse. */
const FREE_PATH = { conifer: 2.3, broadleaf: 2.9, shrub: 1.2 } as const;

/** Trees: forest on the slopes and the scree, alders along the river, gardens, a few in the meadows. */
export function createTrees(random: Random, terrain: Terrain, buildings: readonly Building[]): Tree[] {
  const patches = createFractalNoise(random, 70, 3);
  const trees: Tree[] = [];
  for (let row = -MARGIN / 2; row < SIZE + MARGIN / 2; row += GRID) {
    for (let column = -MARGIN / 2; column < SIZE + MARGIN / 2; column += GRID) {
      const x = column + GRID * random();
      const y = row + GRID * random();
      const chance = random();
      const slope = terrain.slopeAt(x, y);
      if (slope > 1.7 || pavementDistance(x, y) < 3 || !clearOf(buildings, x, y)) continue;
      if (Math.abs(x - lineX(y)) < 11) continue;
      const river = riverDistance(x, y);
      if (river < 9) continue;
      const patch = patches(x, y);
      const rise = terrain.heightAt(x, y) - floorHeight(y);
      const forest = smoothstep(5, 16, rise + 6 * patch) * 0.93;
      const alders = river < 16 ? 0.36 : 0;
      const gardens = nearHouse(buildings, x, y) ? 0.14 : 0;
      if (chance > Math.max(forest, alders, gardens, patch > 0.42 ? 0.1 : 0.004)) continue;
      const wooded = forest > 0.3;
      trees.push(grow(random, x, y, terrain.heightAt(x, y), wooded && random() < 0.78, wooded ? 1 : 0.7));
    }
  }
  return trees;
}

function grow(random: Random, x: number, y: number, ground: number, conifer: boolean, scale: number): Tree {
  const tone = between(random, 0.75, 1.2);
  const crown: Crown = conifer ? "conifer" : random() < 0.16 ? "shrub" : "broadleaf";
  const height =
    scale *
    (conifer
      ? between(random, 13, 29)
      : crown === "shrub"
        ? between(random, 1.2, 3.2)
        : between(random, 8, 18));
  const paint: readonly [number, number, number] = conifer
    ? [0.13 * tone, 0.25 * tone, 0.13 * tone]
    : random() < 0.12
      ? [0.55 * tone, 0.47 * tone, 0.16 * tone]
      : [0.27 * tone, 0.4 * tone, 0.13 * tone];
  const radius = conifer
    ? height * between(random, 0.13, 0.18)
    : crown === "shrub"
      ? 1.3
      : height * between(random, 0.22, 0.32);
  const crownBase = crown === "shrub" ? 0.1 : height * (conifer ? 0.12 : 0.28);
  return { x, y, ground, crownBase, height, radius, crown, paint };
}

function clearOf(buildings: readonly Building[], x: number, y: number): boolean {
  return buildings.every(
    (b) => roofHeightAt(b, x, y) === -Infinity && Math.hypot(x - b.x, y - b.y) > b.halfWidth + 3,
  );
}

function nearHouse(buildings: readonly Building[], x: number, y: number): boolean {
  return inside(x, y) && buildings.some((b) => Math.hypot(x - b.x, y - b.y) < 24);
}

/** Radius of the crown at a height above the ground, metres: a tiered cone, or an ellipsoid. */
function crownRadius(tree: Tree, height: number): number {
  const part = (height - tree.crownBase) / (tree.height - tree.crownBase);
  if (part < 0 || part > 1) return 0;
  if (tree.crown === "conifer") return tree.radius * (1 - part) * (0.85 + 0.15 * Math.cos(part * 40));
  return 2 * tree.radius * Math.sqrt(part * (1 - part));
}

/** Height of the top of the crown over a place, or -Infinity beside the tree. */
export function crownTopAt(tree: Tree, x: number, y: number): number {
  const share = Math.hypot(x - tree.x, y - tree.y) / tree.radius;
  if (share >= 1) return -Infinity;
  const span = tree.height - tree.crownBase;
  const part = tree.crown === "conifer" ? 1 - share : 0.5 + 0.5 * Math.sqrt(1 - share * share);
  return tree.ground + tree.crownBase + span * part;
}

/**
 * Echoes of a pulse on its way through a crown, above `limit`; calls `add` for each in order of range.
 * Where light stops follows from its free path in the foliage, so a pulse may leave several echoes or none.
 */
export function hitTree(
  tree: Tree,
  ray: Ray,
  limit: number,
  random: Random,
  echo: Echo,
  add: () => void,
): void {
  const x = ray.x - tree.x;
  const y = ray.y - tree.y;
  // The way through the upright cylinder around the crown, cut at its top and bottom.
  const level = Math.max(1e-12, ray.dx * ray.dx + ray.dy * ray.dy);
  const nearest = -(x * ray.dx + y * ray.dy) / level;
  const gap = square(x + nearest * ray.dx) + square(y + nearest * ray.dy);
  if (gap >= square(tree.radius)) return;
  const half = Math.sqrt((square(tree.radius) - gap) / level);
  const top = (tree.ground + tree.height - ray.z) / ray.dz;
  const bottom = (tree.ground + tree.crownBase - ray.z) / ray.dz;
  const enter = Math.max(top, nearest - half);
  const leave = Math.min(limit - 0.4, bottom, nearest + half);
  // Free paths in foliage as dense as it gets; where it is thinner, only a share of the stops is real.
  const step = (): number => (-FREE_PATH[tree.crown] / DENSEST) * Math.log(1 - random());
  for (let t = enter + step(); t < leave; t += step()) {
    const height = ray.z + t * ray.dz - tree.ground;
    const radius = crownRadius(tree, height);
    const distance = Math.sqrt(square(x + t * ray.dx) + square(y + t * ray.dy));
    if (distance > radius) continue;
    const share = distance / radius;
    if (random() * DENSEST > THINNEST + (DENSEST - THINNEST) * share) continue;
    const tone = 0.45 + 0.55 * (height / tree.height) * (0.6 + 0.4 * share) + 0.25 * (random() - 0.5);
    echo.range = t;
    echo.classification = vegetationClass(height);
    echo.reflectance = 0.45;
    echo.red = tree.paint[0] * tone * 1.25;
    echo.green = tree.paint[1] * tone * 1.25;
    echo.blue = tree.paint[2] * tone * 1.25;
    echo.sunlit = 0.75;
    echo.solid = false;
    add();
  }
}

/** Class of foliage by its height above the ground: low to 0.5 m, medium to 3 m, high above. */
function vegetationClass(height: number): number {
  if (height < 0.5) return CLASS.lowVegetation;
  return height < 3 ? CLASS.mediumVegetation : CLASS.highVegetation;
}

function square(value: number): number {
  return value * value;
}

import { LOWEST, MARGIN, SIZE } from "./area.js";
import { type Building, createBuildings, hitBuilding } from "./buildings.js";
import { createGroundPainter } from "./ground.js";
import { createLight, type Light } from "./light.js";
import { createPowerLine, hitTower, hitWire, TOWER_HEIGHT, type Tower, type Wire } from "./powerline.js";
import { createRandom, type Random } from "./random.js";
import { CLASS, type Echo, type Ray } from "./ray.js";
import { createTerrain, type Terrain } from "./terrain.js";
import { createTrees, hitTree, type Tree } from "./trees.js";

/** Most slanted pulse that the scene is prepared for: tangent of its angle from the vertical. */
const STEEPEST = 0.62;
/** Bounds on the ground's rise per metre, for stepping along a ray without passing the ground. */
const CLIFF_SLOPE = 4.5;
const VALLEY_SLOPE = 1.6;
/** East of here there is no cliff. */
const CLIFF_EAST = 150;
const CELL = 8;
const CELLS = Math.ceil((SIZE + 2 * MARGIN) / CELL);

/** Everything that a pulse can meet. */
export interface Scene {
  readonly terrain: Terrain;
  readonly light: Light;
  /** Meets of one pulse in order of range, appended to `echoes` (emptied first); none when it is lost. */
  trace(ray: Ray, random: Random, echoes: Echo[]): void;
}

/** What stands where: per cell the things that a slanted ray reaching the ground there may have met. */
interface Cell {
  buildings: Building[];
  trees: Tree[];
  /** Place and radius of each tree again, three numbers each, for a quick look. */
  crowns: Float64Array;
  wires: Wire[];
  towers: Tower[];
}

/** Builds the valley of a seed. */
export function createScene(seed: number): Scene {
  const random = createRandom(seed);
  const terrain = createTerrain(random);
  const buildings = createBuildings(random, terrain);
  const trees = createTrees(random, terrain, buildings);
  const { towers, wires } = createPowerLine(terrain);
  const paint = createGroundPainter(random, terrain);
  const light = createLight(terrain, buildings, trees);
  const cells: Cell[] = Array.from({ length: CELLS * CELLS }, () => ({
    buildings: [],
    trees: [],
    crowns: new Float64Array(),
    wires: [],
    towers: [],
  }));
  for (const it of buildings) {
    const reach = it.halfLength + 2 + STEEPEST * (it.ridge - it.base);
    around(cells, it.x, it.y, reach, (cell) => cell.buildings.push(it));
  }
  for (const it of trees)
    around(cells, it.x, it.y, it.radius + STEEPEST * it.height, (cell) => cell.trees.push(it));
  for (const cell of cells)
    cell.crowns = Float64Array.from(cell.trees.flatMap((it) => [it.x, it.y, it.radius]));
  for (const it of towers)
    around(cells, it.x, it.y, 8 + STEEPEST * TOWER_HEIGHT, (cell) => cell.towers.push(it));
  for (const it of wires) hang(cells, it);

  const trace = (ray: Ray, source: Random, echoes: Echo[]): void => {
    echoes.length = 0;
    const ground = meetGround(terrain, ray);
    const x = ray.x + ground * ray.dx;
    const y = ray.y + ground * ray.dy;
    const cell = cells[cellIndex(x, y)];
    const solid = emptyEcho();
    let limit = ground;
    for (const building of cell.buildings) if (hitBuilding(building, ray, limit, solid)) limit = solid.range;
    const level = Math.sqrt(ray.dx * ray.dx + ray.dy * ray.dy);
    const scratch = emptyEcho();
    const add = (): void => {
      echoes.push({ ...scratch });
    };
    for (let i = 0; i < cell.trees.length; i++) {
      const toX = cell.crowns[3 * i] - x;
      const toY = cell.crowns[3 * i + 1] - y;
      const reach = cell.crowns[3 * i + 2] * level;
      const beyond = toX * ray.dx + toY * ray.dy;
      if (beyond > reach || Math.abs(toX * ray.dy - toY * ray.dx) > reach) continue;
      hitTree(cell.trees[i], ray, limit, source, scratch, add);
    }
    for (const tower of cell.towers) hitTower(tower, ray, limit, source, scratch, add);
    for (const wire of cell.wires) hitWire(wire, ray, limit, source, scratch, add);
    if (limit === ground) {
      paint(x, y, solid);
      solid.range = ground;
      growGrass(solid, source);
    }
    if (echoes.length > 1) echoes.sort((a, b) => a.range - b.range);
    echoes.push(solid);
  };
  return { terrain, light, trace };
}

/** Some meadow echoes come from the grass and not from the soil: a hand's breadth higher, class 3. */
function growGrass(echo: Echo, random: Random): void {
  if (echo.classification !== CLASS.ground || echo.reflectance < 0.47 || random() > 0.07) return;
  echo.range -= 0.12 + 0.3 * random();
  echo.classification = CLASS.lowVegetation;
}

/** Range at which a ray meets the ground, by steps that a ground of bounded slope cannot overtake. */
function meetGround(terrain: Terrain, ray: Ray): number {
  let t = (terrain.top - ray.z) / ray.dz;
  const level = Math.sqrt(ray.dx * ray.dx + ray.dy * ray.dy);
  const lowest = (LOWEST - ray.z) / ray.dz;
  const west = ray.x + Math.min(t * ray.dx, lowest * ray.dx);
  const safe = 1 / (-ray.dz + (west > CLIFF_EAST ? VALLEY_SLOPE : CLIFF_SLOPE) * level);
  for (let i = 0; i < 80; i++) {
    const above = ray.z + t * ray.dz - terrain.heightAt(ray.x + t * ray.dx, ray.y + t * ray.dy);
    if (above < 0.002) break;
    t += above * safe;
  }
  return t;
}

function cellIndex(x: number, y: number): number {
  const column = Math.min(CELLS - 1, Math.max(0, Math.floor((x + MARGIN) / CELL)));
  const row = Math.min(CELLS - 1, Math.max(0, Math.floor((y + MARGIN) / CELL)));
  return row * CELLS + column;
}

function around(cells: Cell[], x: number, y: number, reach: number, put: (cell: Cell) => void): void {
  const west = Math.floor((x - reach + MARGIN) / CELL);
  const south = Math.floor((y - reach + MARGIN) / CELL);
  for (let row = Math.max(0, south); row <= Math.min(CELLS - 1, (y + reach + MARGIN) / CELL); row++) {
    for (
      let column = Math.max(0, west);
      column <= Math.min(CELLS - 1, (x + reach + MARGIN) / CELL);
      column++
    ) {
      put(cells[row * CELLS + column]);
    }
  }
}

/** Enters a wire in every cell along its span, once. */
function hang(cells: Cell[], wire: Wire): void {
  const seen = new Set<Cell>();
  for (let share = 0; share <= 1; share += 0.04) {
    const x = wire.from.x + share * (wire.to.x - wire.from.x);
    const y = wire.from.y + share * (wire.to.y - wire.from.y);
    around(cells, x, y, 8 + STEEPEST * TOWER_HEIGHT, (cell) => seen.add(cell));
  }
  for (const cell of seen) cell.wires.push(wire);
}

function emptyEcho(): Echo {
  return { range: 0, classification: 0, reflectance: 0, red: 0, green: 0, blue: 0, sunlit: 0, solid: false };
}

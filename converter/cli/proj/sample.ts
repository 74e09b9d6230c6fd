import {
  type Bounds,
  boundsOfPlaces,
  CrsError,
  type Domain,
  type EllipsoidAxes,
  ecefToGeodetic,
  geodeticToEcef,
  type ShiftStep,
  spread,
} from "@groma/georef";
import { runToRadians } from "./cct.js";
import { ellipsoidAxes } from "./ellipsoid.js";
import type { Plan, PlannedStep } from "./plan.js";
import type { Proj } from "./program/find.js";
import { OTHER_WAY } from "./refuse.js";
import { type StepText, TO_RADIANS } from "./step-text.js";

/** Metres by which the cells of a raster may be off between its nodes. */
const TOLERANCE = 2e-5;
/** Nodes along each side, at first and at most: then a megabyte. */
const FEWEST = 5;
const MOST = 257;
const DEGREE = Math.PI / 180;
/** Metres per radian, at most. */
const RADIUS = 6.4e6;
/** Rounds of a fixed point that gains five digits in each. */
const ROUNDS = 3;

/** Longitude, latitude (radians) and height. */
type Place = readonly [longitude: number, latitude: number, height: number];

/** Shifts at the nodes of a raster, {@link raster}: of longitude and latitude (radians) and of height (metres). */
type Channels = [east: Float32Array, north: Float32Array, up: Float32Array];

/** Steps of PROJ's as shifts on a raster. */
export interface Sampled {
  readonly steps: readonly ShiftStep[];
  /** Metres: how far points between the nodes were found from PROJ. */
  readonly bound: number;
}

/** An operation, and what z is multiplied by before PROJ gets it. */
interface Placed {
  readonly plan: Plan;
  readonly zScale: number;
}

/** Ellipsoids before and after steps that go through space. */
interface Space {
  readonly from: EllipsoidAxes;
  readonly to: EllipsoidAxes;
  readonly keepHeight: boolean;
}

/**
 * Steps of PROJ's as shifts on a raster over the data set, made finer until points between its nodes are right to
 * {@link TOLERANCE} at the least, the middle and the greatest height. Where the steps go through space, the shift in the
 * middle of the data set is a step of its own, so that little is left to the raster, which does not know of heights.
 *
 * @throws CrsError CRS_OPERATION_UNSUPPORTED where no raster is fine enough
 */
export async function sampleSteps(
  proj: Proj,
  { plan, zScale }: Placed,
  { before: first, after, space }: Extract<PlannedStep, { kind: "sampled" }>,
  domain: Domain,
  signal?: AbortSignal,
): Promise<Sampled> {
  const segment = plan.pipeline.slice(first, after);
  const run = async (places: readonly Place[]): Promise<Place[]> => {
    const degrees = Float64Array.from(places.flatMap(([x, y, z]) => [x / DEGREE, y / DEGREE, z]));
    const out = await runToRadians(proj, [TO_RADIANS, ...segment], degrees, signal);
    return places.map((_, i) => [out[3 * i]!, out[3 * i + 1]!, out[3 * i + 2]!]);
  };
  const points = spread(domain).map((value, i) => (i % 3 === 2 ? value * zScale : value));
  const there = await runToRadians(proj, plan.pipeline.slice(0, first), points, signal);
  const bounds = boundsOfPlaces(there);
  if (!bounds) throw tooRough(segment, Number.NaN);
  const heights = Array.from(there).filter((value, i) => i % 3 === 2 && Number.isFinite(value));
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const middle = (low + high) / 2;
  const centre: Place = [(bounds.west + bounds.east) / 2, (bounds.south + bounds.north) / 2, middle];
  const inSpace = space && {
    from: await ellipsoidAxes(proj, space.from, signal),
    to: await ellipsoidAxes(proj, space.to, signal),
    keepHeight: space.keepHeight,
  };
  const shift = inSpace && shiftThrough(inSpace, centre, (await run([centre]))[0]!);
  const apply = shift?.apply ?? ((place: Place) => place);

  let worst = Number.POSITIVE_INFINITY;
  for (let side = FEWEST; side <= MOST; side = 2 * side - 1) {
    const nodes = raster(bounds, side, middle);
    const wanted = await run(nodes);
    const left = nodes.map((node, i) => remainder(node, wanted[i]!, apply));
    const channels = [0, 1, 2].map((axis) => Float32Array.from(left, (shift) => shift[axis]!)) as Channels;
    const between = betweenNodes(bounds, side, [low, middle, high]);
    const truth = await run(between);
    const before = worst;
    worst = 0;
    for (const [i, place] of between.entries()) {
      const [u, v] = [share(place[0], bounds.west, bounds.east), share(place[1], bounds.south, bounds.north)];
      const [x, y, z] = channels.map((values) => bilinear(values, side, u, v)) as [number, number, number];
      const off = apart(apply([place[0] + x, place[1] + y, place[2] + z]), truth[i]!);
      // Stays not a number once a place is not known.
      worst = Math.max(worst, off);
    }
    if (worst <= TOLERANCE) {
      const steps = rasterSteps(nameOf(segment), bounds, side, channels);
      return { steps: [...steps, ...(shift ? [shift.step] : [])], bound: worst };
    }
    const rounds = Math.log2((MOST - 1) / (side - 1));
    // Not a number: the steps do not reach all of the bounds.
    if (!(worst * (worst / before) ** rounds <= TOLERANCE)) break;
  }
  throw tooRough(segment, worst);
}

/** Shifts at the nodes of a raster as steps; those that are 0 everywhere are none. */
function rasterSteps(name: string, bounds: Bounds, side: number, [east, north, up]: Channels): ShiftStep[] {
  const lattice = {
    ...{ grid: name, west: bounds.west, south: bounds.south, columns: side, rows: side, unit: 1 },
    stepLongitude: (bounds.east - bounds.west) / (side - 1),
    stepLatitude: (bounds.north - bounds.south) / (side - 1),
  };
  const plane = Float32Array.of(...east, ...north);
  const moves = (values: Float32Array) => values.some((value) => value !== 0);
  const steps: ShiftStep[] = [];
  // Heights first: they are looked up at the node's own place.
  if (moves(up)) {
    steps.push({ kind: "verticalShift", multiplier: 1, window: { ...lattice, channels: 1, values: up } });
  }
  if (moves(plane)) {
    const window = { ...lattice, channels: 2, values: plane };
    steps.push({ kind: "horizontalShift", direction: "forward", window });
  }
  return steps;
}

/** The translation that takes a place where the steps take it. */
function shiftThrough({ from, to, keepHeight }: Space, place: Place, there: Place) {
  const [start, end] = [from, to].map(({ a, f }) => ({ a, f, e2: f * (2 - f) })) as [Shape, Shape];
  const [before, after] = [new Float64Array(3), new Float64Array(3)];
  geodeticToEcef(...place, before, 0, start);
  geodeticToEcef(...there, after, 0, end);
  const translation = [0, 1, 2].map((axis) => after[axis]! - before[axis]!) as [number, number, number];
  const matrix = [1, 0, 0, 0, 1, 0, 0, 0, 1];
  const step: ShiftStep = { kind: "datumShift", from, to, translation, matrix, keepHeight };
  const out = new Float64Array(3);
  const apply = ([longitude, latitude, height]: Place): Place => {
    geodeticToEcef(longitude, latitude, height, out, 0, start);
    const [x, y, z] = translation.map((value, axis) => value + out[axis]!) as [number, number, number];
    ecefToGeodetic(x, y, z, out, 0, end);
    return [out[0]!, out[1]!, keepHeight ? height : out[2]!];
  };
  return { step, apply };
}

type Shape = NonNullable<Parameters<typeof geodeticToEcef>[5]>;

/** What has to be added to a place so that the shift leads where the steps do. */
function remainder(place: Place, wanted: Place, apply: (place: Place) => Place): Place {
  let left: Place = [0, 0, 0];
  for (let i = 0; i < ROUNDS; i++) {
    const [x, y, z] = apply([place[0] + left[0], place[1] + left[1], place[2] + left[2]]);
    left = [left[0] + turned(wanted[0] - x), left[1] + wanted[1] - y, left[2] + wanted[2] - z];
  }
  return left;
}

/** A difference of longitudes without whole turns. */
function turned(radians: number): number {
  return radians - 2 * Math.PI * Math.round(radians / (2 * Math.PI));
}

/** Metres, no less than the distance. */
function apart(a: Place, b: Place): number {
  return Math.hypot(turned(a[0] - b[0]) * RADIUS, (a[1] - b[1]) * RADIUS, a[2] - b[2]);
}

/** Row by row from the south-west. */
function raster({ west, south, east, north }: Bounds, side: number, height: number): Place[] {
  const at = (from: number, to: number, i: number) => from + ((to - from) * i) / (side - 1);
  return Array.from({ length: side * side }, (_, i) => {
    return [at(west, east, i % side), at(south, north, Math.floor(i / side)), height];
  });
}

/** The places halfway between the nodes of a raster, along its lines and in its cells, at each of some heights. */
function betweenNodes(bounds: Bounds, side: number, heights: readonly number[]): Place[] {
  const fine = 2 * side - 1;
  const isBetween = (i: number) => (i % fine) & 1 || Math.floor(i / fine) & 1;
  return heights.flatMap((height) => raster(bounds, fine, height).filter((_, i) => isBetween(i)));
}

function share(value: number, from: number, to: number): number {
  return (value - from) / (to - from);
}

/** @param u share of the width, 0 to 1, and v of the height */
function bilinear(values: Float32Array, side: number, u: number, v: number): number {
  const column = Math.min(side - 2, Math.floor(u * (side - 1)));
  const row = Math.min(side - 2, Math.floor(v * (side - 1)));
  const [x, y] = [u * (side - 1) - column, v * (side - 1) - row];
  const at = row * side + column;
  const south = values[at]! + x * (values[at + 1]! - values[at]!);
  const north = values[at + side]! + x * (values[at + side + 1]! - values[at + side]!);
  return south + y * (north - south);
}

/** Of the files that the steps read, or of the steps themselves. */
function nameOf(segment: readonly StepText[]): string {
  const files = segment.flatMap(({ parameters }) => parameters.get("grids") ?? parameters.get("file") ?? []);
  return files.length > 0 ? files.join(", ") : segment.map(({ name }) => name).join(", ");
}

function tooRough(segment: readonly StepText[], worst: number): CrsError {
  const steps = segment.map(({ name }) => `"${name}"`).join(", ");
  return new CrsError({
    code: "CRS_OPERATION_UNSUPPORTED",
    file: "PROJ",
    cause: Number.isNaN(worst)
      ? `what ${steps} does is not known in all of the data set`
      : `what ${steps} does over the data set fits on no raster of ${MOST} × ${MOST} nodes (${worst.toPrecision(2)} m off)`,
    fix: OTHER_WAY,
  });
}

import { floorHeight, HIGHEST, inside, LOWEST, ORIGIN, SIZE } from "./area.js";
import type { LasPoint } from "./las-writer.js";
import type { Random } from "./random.js";
import { CLASS, type Echo, type Ray } from "./ray.js";
import type { Scene } from "./scene.js";

/** A straight flight over the square: start and unit direction in local metres. */
interface FlightLine {
  id: number;
  x: number;
  y: number;
  dx: number;
  dy: number;
}

const ALTITUDE = 1000;
const FLIGHT_HEIGHT = floorHeight(SIZE / 2) + ALTITUDE;
const SPEED = 60;
/** Half the field of view across the flight, and how far each channel looks ahead or back, as tangents. */
const ACROSS = 0.5;
const AHEAD = [0.36, -0.36] as const;
/** The first channel sees the near edge before the aircraft is over it, the second the far edge after. */
const RUN_IN = ALTITUDE * AHEAD[0] + 60;
const MAX_ECHOES = 5;
/** Two echoes closer than this are one to the receiver, metres. */
const RANGE_RESOLUTION = 0.7;
const RANGE_NOISE = 0.015;
/** Echoes that one metre of pulse spacing yields over the whole square, counted once. */
const ECHOES_AT_ONE_METRE = 2_300_000;
/** Adjusted standard GPS time (GPS seconds - 10⁹) of the first flight line: 12 June 2025, 08:30 UTC. */
const START_TIME = 1_433_752_218 - 1e9;
const TURN_SECONDS = 140;

const LINES: readonly FlightLine[] = [
  { id: 101, x: 90, y: 0, dx: 0, dy: 1 },
  { id: 102, x: 260, y: SIZE, dx: 0, dy: -1 },
  { id: 103, x: 430, y: 0, dx: 0, dy: 1 },
  { id: 104, x: 0, y: 125, dx: 1, dy: 0 },
  { id: 105, x: SIZE, y: 395, dx: -1, dy: 0 },
];

/**
 * A scanner with two crossing fans, one looking ahead and one back, so that walls are hit from every side.
 * Flies every line and calls `record` with one point object (reused) per echo, in order of GPS time.
 */
export function scan(scene: Scene, random: Random, points: number, record: (point: LasPoint) => void): void {
  const spacing = Math.sqrt(ECHOES_AT_ONE_METRE / points);
  const acrossCount = Math.round((2 * ALTITUDE * ACROSS) / spacing);
  const flight = SIZE + 2 * RUN_IN;
  const rows = Math.round(flight / spacing);
  const pulseSeconds = flight / SPEED / (rows * acrossCount);
  const ray: Ray = { x: 0, y: 0, z: 0, dx: 0, dy: 0, dz: 0 };
  const echoes: Echo[] = [];
  const point = {} as LasPoint;
  LINES.forEach((line, index) => {
    const start = START_TIME + index * (flight / SPEED + TURN_SECONDS);
    const aside = line.dy === 0 ? line.y : line.x;
    const toEast = line.dy - line.dx;
    for (let pulse = 0; pulse < rows * acrossCount; pulse++) {
      const column = pulse % acrossCount;
      const channel = (pulse + Math.floor(pulse / acrossCount)) % 2;
      const along = pulse * pulseSeconds * SPEED - RUN_IN;
      const middle = ACROSS * (-1 + (2 * column + 1) / acrossCount);
      if (misses(along, AHEAD[channel], spacing) || misses(aside, toEast * middle, spacing)) continue;
      const across = middle + (ACROSS * (2 * random() - 1)) / acrossCount;
      aim(ray, line, along + spacing * (random() - 0.5), across, AHEAD[channel]);
      scene.trace(ray, random, echoes);
      const heard = receive(echoes, random);
      if (heard === 0 || !allInside(ray, echoes, heard)) continue;
      point.gpsTime = start + pulse * pulseSeconds;
      point.scanAngle = Math.atan(across);
      point.scannerChannel = channel;
      point.edgeOfFlightLine = column === acrossCount - 1;
      point.pointSource = line.id;
      emit(scene, ray, echoes, heard, random, point, record);
    }
  });
}

/** Points the ray from the aircraft's place on its line: tangents across (right positive) and ahead. */
function aim(ray: Ray, line: FlightLine, along: number, across: number, ahead: number): void {
  const length = Math.sqrt(1 + across * across + ahead * ahead);
  ray.x = line.x + line.dx * along;
  ray.y = line.y + line.dy * along;
  ray.z = FLIGHT_HEIGHT;
  ray.dx = (line.dy * across + line.dx * ahead) / length;
  ray.dy = (-line.dx * across + line.dy * ahead) / length;
  ray.dz = -1 / length;
}

/** True for pulses that pass the square along one axis, whether they meet the highest ground or the lowest. */
function misses(from: number, tangent: number, jitter: number): boolean {
  const high = from + tangent * (FLIGHT_HEIGHT - HIGHEST);
  const low = from + tangent * (FLIGHT_HEIGHT - LOWEST);
  return Math.max(high, low) < -jitter || Math.min(high, low) > SIZE + jitter;
}

/**
 * Leaves at the front of `echoes` what the receiver tells apart, and returns how many: each echo takes its
 * share of the pulse, close ones merge, and what is left too faint is not heard. `reflectance` becomes energy.
 */
function receive(echoes: Echo[], random: Random): number {
  let energy = 1;
  let heard = 0;
  let last = -Infinity;
  for (const echo of echoes) {
    if (echo.range - last < RANGE_RESOLUTION || heard === MAX_ECHOES) continue;
    if (echo.classification === CLASS.water && random() < 0.5) continue;
    const share = echo.solid ? 1 : 0.25 + 0.3 * random();
    if (energy * share < 0.1) break;
    echo.reflectance *= energy * share;
    energy *= 1 - share;
    last = echo.range;
    echoes[heard++] = echo;
  }
  return heard;
}

function allInside(ray: Ray, echoes: readonly Echo[], count: number): boolean {
  for (let i = 0; i < count; i++) {
    const { range } = echoes[i];
    if (!inside(ray.x + range * ray.dx, ray.y + range * ray.dy)) return false;
  }
  return true;
}

function emit(
  scene: Scene,
  ray: Ray,
  echoes: readonly Echo[],
  count: number,
  random: Random,
  point: LasPoint,
  record: (point: LasPoint) => void,
): void {
  point.returns = count;
  for (let i = 0; i < count; i++) {
    const echo = echoes[i];
    // Sum of four uniforms: near enough to normal, and the same on every machine.
    const range = echo.range + RANGE_NOISE * (random() + random() + random() + random() - 2) * 1.7;
    const x = Math.min(SIZE - 0.001, Math.max(0, ray.x + range * ray.dx));
    const y = Math.min(SIZE - 0.001, Math.max(0, ray.y + range * ray.dy));
    const z = ray.z + range * ray.dz;
    const sun = scene.light(x, y, z) * echo.sunlit;
    point.x = ORIGIN.east + x;
    point.y = ORIGIN.north + y;
    point.z = z;
    point.returnNumber = i + 1;
    point.classification = echo.classification;
    point.intensity = sixteenBit(echo.reflectance * (0.9 + 0.2 * random()));
    point.red = sixteenBit(echo.red * (0.5 + 0.86 * sun));
    point.green = sixteenBit(echo.green * (0.53 + 0.82 * sun));
    point.blue = sixteenBit(echo.blue * (0.62 + 0.7 * sun));
    record(point);
  }
}

function sixteenBit(value: number): number {
  return Math.round(65535 * Math.min(1, Math.max(0, value)));
}

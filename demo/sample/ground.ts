import { smoothstep } from "./area.js";
import { createFractalNoise, type Noise, type Random } from "./random.js";
import { CLASS, type Echo, sunOn } from "./ray.js";
import { RIVER_HALF_WIDTH, riverDistance } from "./river.js";
import { pavementAt, pavementDistance } from "./road.js";
import type { Terrain } from "./terrain.js";

/** Where a waterfall comes down the rock face, northing. */
const FALL_Y = 366;

/** Paints the bare ground and says what it is: fills class, reflectance and colour of an echo at a place. */
export type GroundPainter = (x: number, y: number, echo: Echo) => void;

/** Meadows in strips of different mowing, rock where it is steep, gravel by the river, asphalt and paint. */
export function createGroundPainter(random: Random, terrain: Terrain): GroundPainter {
  const fine = createFractalNoise(random, 5, 2);
  const coarse = createFractalNoise(random, 60, 2);
  const strata = createFractalNoise(random, 40, 3);
  const normal = new Float64Array(3);
  return (x, y, echo) => {
    terrain.normalAt(x, y, normal);
    echo.sunlit = sunOn(normal[0], normal[1], normal[2]);
    echo.solid = true;
    echo.classification = CLASS.ground;
    const slope = Math.sqrt(1 - normal[2] * normal[2]) / normal[2];
    const river = riverDistance(x, y);
    const pavement = pavementAt(x, y);
    const grain = 1 + 0.16 * fine(x, y);
    if (pavement !== "none") return pave(echo, pavement, grain);
    if (river < RIVER_HALF_WIDTH) return water(echo, 0.5 + 0.5 * fine(x * 0.5, y), river / RIVER_HALF_WIDTH);
    const fall = x < 128 && slope > 1.2 ? Math.abs(y - FALL_Y + 3 * fine(x, y)) : Infinity;
    if (fall < 2.6) return water(echo, 1.6 + 0.4 * grain, 0);
    const rock = smoothstep(0.85, 1.25, slope + 0.2 * (grain - 1));
    const bands = rock > 0 ? strata(terrain.heightAt(x, y) * 1.6, x * 0.04 + y * 0.04) : 0;
    const gravel = smoothstep(5, 2, river - RIVER_HALF_WIDTH);
    meadow(echo, x, y, coarse, grain);
    blend(
      echo,
      rock,
      (0.56 + 0.14 * bands) * grain,
      (0.53 + 0.12 * bands) * grain,
      (0.48 + 0.1 * bands) * grain,
    );
    blend(echo, gravel, 0.66 * grain, 0.64 * grain, 0.6 * grain);
    const verge = smoothstep(1.2, 0, pavementDistance(x, y));
    blend(echo, verge, 0.56 * grain, 0.53 * grain, 0.45 * grain);
    echo.reflectance = 0.5 - 0.2 * rock;
  };
}

function meadow(echo: Echo, x: number, y: number, coarse: Noise, grain: number): void {
  // Strips of land square to the river, each mown at its own time, with the tracks of the mower along them.
  const strip = Math.floor((y + 14 * coarse(x, 0)) / 46);
  const side = x < 240 ? 0 : x < 318 ? 1 : 2;
  const mown = fraction(Math.sin(strip * 12.9898 + side * 78.233) * 43758.5453);
  const track = 1 + 0.03 * Math.sign(Math.sin(y * 1.15)) * (mown > 0.45 ? 1 : 0);
  const dry = smoothstep(-0.4, 0.9, coarse(x + 900, y)) * 0.35 + 0.5 * mown;
  const light = grain * track;
  echo.red = (0.3 + 0.26 * dry) * light;
  echo.green = (0.45 + 0.13 * dry) * light;
  echo.blue = (0.17 + 0.1 * dry) * light;
}

function pave(echo: Echo, pavement: "asphalt" | "marking" | "bridge", grain: number): void {
  const tone = pavement === "marking" ? 0.95 : (pavement === "bridge" ? 0.62 : 0.4) * grain;
  echo.classification = pavement === "bridge" ? CLASS.bridge : CLASS.road;
  echo.reflectance = pavement === "marking" ? 0.8 : 0.18;
  echo.red = tone;
  echo.green = tone;
  echo.blue = tone * 1.03;
}

function water(echo: Echo, foam: number, share: number): void {
  const white = Math.max(0, foam - 0.62) * 1.1 + 0.12 * share;
  echo.classification = CLASS.water;
  echo.reflectance = 0.1;
  echo.red = Math.min(0.95, 0.36 + white);
  echo.green = Math.min(0.97, 0.55 + white * 0.9);
  echo.blue = Math.min(0.98, 0.6 + white * 0.8);
  echo.sunlit = Math.max(echo.sunlit, 0.6);
}

function blend(echo: Echo, share: number, red: number, green: number, blue: number): void {
  echo.red += share * (red - echo.red);
  echo.green += share * (green - echo.green);
  echo.blue += share * (blue - echo.blue);
}

function fraction(value: number): number {
  return value - Math.floor(value);
}

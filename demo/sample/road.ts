import { floorHeight, smoothstep } from "./area.js";
import { RIVER_HALF_WIDTH, riverDistance } from "./river.js";

/** Half widths of the paved strips, metres. */
const ROAD_HALF_WIDTH = 3.4;
const LANE_HALF_WIDTH = 2.2;
/** Northing of the lane that leaves the valley road to the west, and its western end. */
const LANE_Y = 255;
const LANE_WEST = 138;
const EMBANKMENT = 7;
const ABOVE_FLOOR = 0.5;

/** Easting of the valley road's centre line at northing y, local metres. */
export function roadX(y: number): number {
  return 318 + 15 * Math.sin(y / 130 + 2);
}

/** Signed distance from the valley road's centre line, metres; east is positive. */
function roadOffset(x: number, y: number): number {
  const slope = (15 / 130) * Math.cos(y / 130 + 2);
  return (x - roadX(y)) / Math.sqrt(1 + slope * slope);
}

/** Northing of the lane's centre line at easting x. */
export function laneY(x: number): number {
  return LANE_Y + 10 * Math.sin((x - 318) / 60);
}

function laneDistance(x: number, y: number): number {
  const beyond = Math.max(0, LANE_WEST - x, x - roadX(y));
  return Math.hypot(y - laneY(x), beyond);
}

export type Pavement = "none" | "asphalt" | "marking" | "bridge";

/** What is paved at a place: asphalt, the painted line of the valley road, or the bridge over the river. */
export function pavementAt(x: number, y: number): Pavement {
  const offset = roadOffset(x, y);
  if (Math.abs(offset) < ROAD_HALF_WIDTH) {
    const edge = Math.abs(Math.abs(offset) - 3.1) < 0.14;
    const centre = Math.abs(offset) < 0.16 && y % 9 < 5;
    return edge || centre ? "marking" : "asphalt";
  }
  if (laneDistance(x, y) >= LANE_HALF_WIDTH) return "none";
  return riverDistance(x, y) < RIVER_HALF_WIDTH + 4 ? "bridge" : "asphalt";
}

/** Distance from the nearest paved edge, metres; negative on the pavement. */
export function pavementDistance(x: number, y: number): number {
  return Math.min(Math.abs(roadOffset(x, y)) - ROAD_HALF_WIDTH, laneDistance(x, y) - LANE_HALF_WIDTH);
}

/** Ground height with the road bed in it: level across, on a low embankment, over the river as a bridge. */
export function layRoad(ground: number, x: number, y: number): number {
  const distance = pavementDistance(x, y);
  if (distance > EMBANKMENT) return ground;
  const bed = floorHeight(y) + ABOVE_FLOOR;
  const overRiver = riverDistance(x, y) < RIVER_HALF_WIDTH + 4;
  const reach = overRiver ? 0.6 : EMBANKMENT;
  return bed + (ground - bed) * smoothstep(0.3, reach, distance);
}

import type { Bounds } from "@groma/georef";
import type { DegreeBox } from "./operation.js";

const TURN = 2 * Math.PI;

/** For `projinfo --bbox`: all longitudes where the bounds go half round the earth or more. */
export function degreeBox({ west, south, east, north }: Bounds): DegreeBox {
  const degrees = (radians: number) => (radians * 180) / Math.PI;
  const turned = (radians: number) => radians - TURN * Math.round(radians / TURN);
  const around = east - west >= Math.PI;
  return {
    west: around ? -180 : degrees(turned(west)),
    south: degrees(south),
    east: around ? 180 : degrees(turned(east)),
    north: degrees(north),
  };
}

import { eastNorthUp } from "@groma/georef";
import { StyleError } from "../errors/index.js";

/** Metres. Beyond that the octree's horizon, which the offset moves along, would hide what is in sight. */
const GREATEST = 10_000;

/** @throws StyleError STYLE_HEIGHT_OFFSET for what is no length of that kind */
export function checkHeightOffset(metres: number, file: string): number {
  if (typeof metres === "number" && Math.abs(metres) <= GREATEST) return metres;
  throw new StyleError({
    code: "STYLE_HEIGHT_OFFSET",
    file,
    cause: `points cannot be drawn ${metres} m above their positions`,
    fix: `Use metres from ${-GREATEST} to ${GREATEST}`,
  });
}

/** What a height offset adds to a place, along its up: ECEF, metres. */
export function liftOf(
  { x, y, z }: { readonly x: number; readonly y: number; readonly z: number },
  heightOffset: number,
): readonly [number, number, number] {
  if (heightOffset === 0) return [0, 0, 0];
  const { rotation } = eastNorthUp([x, y, z]);
  return [heightOffset * rotation[6], heightOffset * rotation[7], heightOffset * rotation[8]];
}

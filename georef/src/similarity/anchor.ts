import { eastNorthUp } from "../ellipsoid/frame.js";
import { geodeticToEcef } from "../ellipsoid/geodetic-to-ecef.js";
import type { Similarity } from "../engines/truth.js";
import { requireFields } from "../errors/arguments.js";

/** Where a data set without a coordinate reference system is put: upright, its y axis along a heading. */
export interface Anchor {
  /** Radians, WGS 84. */
  readonly longitude: number;
  readonly latitude: number;
  /** Metres above the WGS 84 ellipsoid. */
  readonly height: number;
  /** Radians clockwise from north to the source's +y axis; +x is a quarter turn clockwise from it, +z up. */
  readonly heading: number;
  /** Metres per source unit, > 0. */
  readonly scale: number;
  /** Source coordinates of the point that is put there. */
  readonly at: readonly [number, number, number];
}

/**
 * The similarity that an anchor describes.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function anchorSimilarity(anchor: Anchor): Similarity {
  requireFields(
    anchor,
    {
      longitude: "number",
      latitude: "number",
      height: "number",
      heading: "number",
      scale: "number",
      at: "numbers",
    },
    "anchorSimilarity: anchor",
  );
  const { longitude, latitude, height, heading, scale, at } = anchor;
  const origin = new Float64Array(3);
  geodeticToEcef(longitude, latitude, height, origin);
  const { rotation } = eastNorthUp(origin);
  const [sin, cos] = [Math.sin(heading), Math.cos(heading)];
  const matrix: number[] = [];
  for (let axis = 0; axis < 3; axis++) {
    const [east, north, up] = [rotation[axis], rotation[3 + axis], rotation[6 + axis]];
    matrix.push(scale * (east * cos - north * sin), scale * (east * sin + north * cos), scale * up);
  }
  const from = (axis: number) =>
    origin[axis] - matrix[3 * axis] * at[0] - matrix[3 * axis + 1] * at[1] - matrix[3 * axis + 2] * at[2];
  return { translation: [from(0), from(1), from(2)], matrix };
}

import { type Domain, eastNorthUp, type Placement, type PointTransform, pointIn } from "@groma/georef";
import { invert, localOf, stepsOver } from "./cube-map.js";
import type { NodeOnGlobe } from "./protocol.js";

/** Samples along each axis. */
const SIDE = [-1, 0, 1];

/**
 * Where a node that is placed on a map lies on the globe: the affine map through its middle, by the secants of both
 * placings, with the error found at a grid of 3 × 3 × 3 places. It bends away by the square of the node's size over the
 * radius of the earth: a centimetre for 500 m.
 * @param globe source coordinates → ECEF
 * @param placement to the map
 * @param domain box of the points, source units
 * @param edge of the node's cube, source units
 * @returns undefined where part of the node has no place on the globe
 */
export function onGlobe(
  globe: PointTransform,
  placement: Placement,
  { minX, minY, minZ, maxX, maxY, maxZ }: Domain,
  edge: number,
): NodeOnGlobe | undefined {
  const [low, high] = [
    [minX, minY, minZ],
    [maxX, maxY, maxZ],
  ];
  const middle = low.map((from, axis) => (from + high[axis]) / 2);
  const step = stepsOver(low, high, edge > 0 ? edge : 1);
  const ecef = new Float64Array(3);
  globe(middle[0], middle[1], middle[2], ecef, 0);
  if (!ecef.every(Number.isFinite)) return undefined;
  const frame = eastNorthUp(ecef);
  const samples = SIDE.flatMap((i) =>
    SIDE.flatMap((j) =>
      SIDE.map((k) => {
        const place = [i, j, k].map((side, axis) => middle[axis] + side * step[axis]);
        globe(place[0], place[1], place[2], ecef, 0);
        return { map: localOf(placement, place), globe: pointIn(frame, ecef[0], ecef[1], ecef[2]) };
      }),
    ),
  );
  if (!samples.every(({ map, globe }) => [...map, ...globe].every(Number.isFinite))) return undefined;
  // Of the grid, the middle and the places before and behind it along each axis.
  const [beside, centre] = [[9, 3, 1], 13];
  const secants = (of: "map" | "globe") =>
    beside.map((away) =>
      [0, 1, 2].map((axis) => samples[centre + away][of][axis] - samples[centre - away][of][axis]),
    );
  const toSteps = invert(secants("map"));
  const columns = secants("globe");
  const rows = [0, 1, 2].map((axis) => {
    const row = [0, 1, 2].map((k) =>
      columns.reduce((sum, column, n) => sum + column[axis] * toSteps[n][k], 0),
    );
    const { map, globe } = samples[centre];
    return [...row, globe[axis] - row.reduce((sum, value, k) => sum + value * map[k], 0)];
  });
  let error = 0;
  const box = Float32Array.of(
    ...[1, 1, 1].map(() => Number.POSITIVE_INFINITY),
    ...[1, 1, 1].map(() => -Infinity),
  );
  for (const { map, globe } of samples) {
    const off = rows.map(
      (row, axis) => row[0] * map[0] + row[1] * map[1] + row[2] * map[2] + row[3] - globe[axis],
    );
    error = Math.max(error, Math.hypot(...off));
    for (let axis = 0; axis < 3; axis++) {
      box[axis] = Math.min(box[axis], globe[axis]);
      box[axis + 3] = Math.max(box[axis + 3], globe[axis]);
    }
  }
  for (let axis = 0; axis < 3; axis++) {
    box[axis] -= error;
    box[axis + 3] += error;
  }
  return { frame, box, fromMap: Float32Array.from(rows.flat()), error };
}

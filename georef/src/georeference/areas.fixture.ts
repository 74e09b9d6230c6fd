import { radians } from "../cartesian/points.fixture.js";
import { lookup } from "../crs/epsg-table.fixture.js";
import { type Crs, type Domain, type ExactTransform, exactTransform, resolveCrs } from "../index.js";

/** A CRS with a rectangle of its plane in which nodes may lie, and the size of the largest node that makes sense. */
export interface CrsArea {
  readonly crs: Crs;
  readonly exact: ExactTransform;
  /** minX, minY, maxX, maxY in source units. */
  readonly area: readonly [number, number, number, number];
  /** Metres. */
  readonly largest: number;
}

/** One of each kind of projection, datum shift and unit; polar and global ones included. */
const AREAS: readonly (readonly [given: string, area: CrsArea["area"], largest: number])[] = [
  ["EPSG:32633", [166000, 0, 834000, 9.3e6], 1e6],
  ["EPSG:21781", [485000, 75000, 835000, 295000], 1e5],
  ["EPSG:2056+5728", [2485000, 1075000, 2835000, 1295000], 1e5],
  ["EPSG:2994", [603254, 0, 2570000, 1570000], 1e6],
  ["EPSG:28992", [12000, 306000, 272000, 616000], 1e5],
  ["EPSG:27700", [5000, 10000, 655000, 1210000], 1e5],
  ["EPSG:31287", [110000, 280000, 680000, 570000], 1e5],
  ["EPSG:3035", [2.6e6, 1.5e6, 6e6, 5.4e6], 1e6],
  ["EPSG:3857", [-2.0e7, -1e7, 2.0e7, 1e7], 1e6],
  ["EPSG:5514", [-900000, -1330000, -200000, -940000], 1e5],
  ["EPSG:2193", [1.09e6, 4.75e6, 2.09e6, 6.22e6], 1e6],
  ["EPSG:5041", [1e6, 1e6, 3e6, 3e6], 1e6],
  ["EPSG:3413", [-2.5e6, -2.5e6, 2.5e6, 2.5e6], 1e6],
  ["EPSG:2263", [915000, 120000, 1595000, 380000], 1e5],
  ["EPSG:4326", [-180, -75, 180, 75], 1e6],
];

export const crsAreas: readonly CrsArea[] = AREAS.map(([given, area, largest]) => {
  const crs = resolveCrs({ file: given, given }, lookup);
  return { crs, exact: exactTransform(crs), area, largest };
});

/**
 * A square node of a given edge (metres) in a CRS, in source units.
 *
 * @param at place of its centre in the area, 0 … 1 in x and y
 * @param height middle height, metres
 */
export function squareNode(
  { crs, area }: CrsArea,
  edge: number,
  at: readonly [number, number],
  height: number,
): Domain {
  const x = area[0] + (area[2] - area[0]) * at[0];
  const y = area[1] + (area[3] - area[1]) * at[1];
  const angular = crs.horizontalUnit.kind === "angular";
  const metre = 1 / (crs.horizontalUnit.size * (angular ? 6378137 : 1));
  const halfY = (edge / 2) * metre;
  const halfX = angular ? halfY / Math.cos(radians(y)) : halfY;
  const z = height / crs.verticalUnit.size;
  const halfZ = Math.min(edge / 2, 5000) / crs.verticalUnit.size;
  return {
    minX: x - halfX,
    maxX: x + halfX,
    minY: y - halfY,
    maxY: y + halfY,
    minZ: z - halfZ,
    maxZ: z + halfZ,
  };
}

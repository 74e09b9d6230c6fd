import type { KeyValues } from "./geotiff-keys.js";
import { unsupported } from "./refusal.js";
import type { WktItem } from "./tree.js";

const PROJECTION = 3074;
const COORDINATE_TRANSFORMATION = 3075;

/** UTM zones among the codes of GeoTIFF's ProjectionGeoKey: 160zz north, 161zz south (EPSG coordinate operations). */
const UTM_NORTH = 16000;
const UTM_SOUTH = 16100;

/** Coordinate transformation codes (GeoTIFF 1.0, 6.3.3.3) and the WKT1 names of the projections. */
const METHODS: ReadonlyMap<number, string> = new Map([
  [1, "Transverse_Mercator"],
  [7, "Mercator_1SP"],
  [8, "Lambert_Conformal_Conic_2SP"],
  [9, "Lambert_Conformal_Conic_1SP"],
  [10, "Lambert_Azimuthal_Equal_Area"],
  [11, "Albers_Conic_Equal_Area"],
  [13, "Equidistant_Conic"],
  [15, "Polar_Stereographic"],
  [16, "Oblique_Stereographic"],
  [22, "Polyconic"],
  [26, "New_Zealand_Map_Grid"],
]);

/**
 * Parameter keys and the WKT1 parameter each stands for. Writers put one meaning under several keys (natural origin,
 * false origin, centre); the first key that is there counts.
 */
const PARAMETERS: readonly (readonly [name: string, ...keys: number[]])[] = [
  ["standard_parallel_1", 3078],
  ["standard_parallel_2", 3079],
  ["central_meridian", 3080, 3084, 3088, 3095],
  ["latitude_of_origin", 3081, 3085, 3089],
  ["false_easting", 3082, 3086, 3090],
  ["false_northing", 3083, 3087, 3091],
  ["scale_factor", 3092, 3093],
];

/**
 * PROJECTION and PARAMETER nodes of WKT1 for user-defined projected keys.
 * @throws Refusal CRS_UNSUPPORTED
 */
export function conversionNodes(values: KeyValues): WktItem[] {
  const zone = values.get(PROJECTION);
  if (typeof zone === "number" && zone > UTM_NORTH && zone <= UTM_SOUTH + 60) return utm(zone);
  const transformation = values.get(COORDINATE_TRANSFORMATION);
  const name = typeof transformation === "number" ? METHODS.get(transformation) : undefined;
  if (name === undefined) {
    throw unsupported(
      `the map projection of the GeoTIFF keys (${transformation ?? "none named"}) is not supported`,
    );
  }
  const nodes: WktItem[] = [["PROJECTION", name]];
  for (const [parameter, ...keys] of PARAMETERS) {
    const value = keys.map((key) => values.get(key)).find((found) => typeof found === "number");
    if (value !== undefined) nodes.push(["PARAMETER", parameter, value]);
  }
  return nodes;
}

function utm(projection: number): WktItem[] {
  const south = projection > UTM_SOUTH;
  const zone = projection - (south ? UTM_SOUTH : UTM_NORTH);
  if (zone < 1 || zone > 60) throw unsupported(`projection ${projection} of the GeoTIFF keys is no UTM zone`);
  return [
    ["PROJECTION", "Transverse_Mercator"],
    ["PARAMETER", "latitude_of_origin", 0, ["ANGLEUNIT", "degree", Math.PI / 180]],
    ["PARAMETER", "central_meridian", 6 * zone - 183, ["ANGLEUNIT", "degree", Math.PI / 180]],
    ["PARAMETER", "scale_factor", 0.9996],
    ["PARAMETER", "false_easting", 500000, ["LENGTHUNIT", "metre", 1]],
    ["PARAMETER", "false_northing", south ? 10000000 : 0, ["LENGTHUNIT", "metre", 1]],
  ];
}

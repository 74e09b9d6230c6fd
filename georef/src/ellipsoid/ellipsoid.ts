/** An oblate ellipsoid of revolution (or a sphere): `a` equatorial radius in metres, `f` flattening, `e2` = f(2 − f). */
export interface Ellipsoid {
  readonly a: number;
  readonly f: number;
  readonly e2: number;
}

/** Ellipsoid from its equatorial radius (metres) and flattening (0 for a sphere). */
export function ellipsoid(a: number, f: number): Ellipsoid {
  return { a, f, e2: f * (2 - f) };
}

/** WGS 84 (EPSG:7030), the ellipsoid of ECEF as EPSG:4978 means it. */
export const WGS84: Ellipsoid = ellipsoid(6378137, 1 / 298.257223563);

/** Shape of an ellipsoid as CRS texts give it: equatorial radius in metres, inverse flattening (0 for a sphere). */
export interface Figure {
  readonly a: number;
  readonly rf: number;
}

export const WGS84_FIGURE: Figure = { a: 6378137, rf: 298.257223563 };
const GRS80_FIGURE: Figure = { a: 6378137, rf: 298.257222101 };

/** Inverse flattening of an ellipsoid given by its two axes. */
function axes(a: number, b: number): Figure {
  return { a, rf: a / (a - b) };
}

/** EPSG ellipsoid code, PROJ name, figure (EPSG registry; PROJ, ellps.cpp). */
const TABLE: readonly (readonly [code: number, proj: string, figure: Figure])[] = [
  [7030, "WGS84", WGS84_FIGURE],
  [7019, "GRS80", GRS80_FIGURE],
  [7004, "bessel", { a: 6377397.155, rf: 299.1528128 }],
  [7005, "bess_mod", { a: 6377492.018, rf: 299.1528128 }],
  [7046, "bess_nam", { a: 6377483.865, rf: 299.1528128 }],
  [7001, "airy", { a: 6377563.396, rf: 299.3249646 }],
  [7002, "mod_airy", { a: 6377340.189, rf: 299.3249646 }],
  [7003, "aust_SA", { a: 6378160, rf: 298.25 }],
  [7008, "clrk66", axes(6378206.4, 6356583.8)],
  [7011, "clrk80ign", axes(6378249.2, 6356515)],
  [7012, "clrk80", { a: 6378249.145, rf: 293.465 }],
  [7013, "clrk80arc", { a: 6378249.145, rf: 293.4663077 }],
  [7015, "evrst30", { a: 6377276.345, rf: 300.8017 }],
  [7016, "evrst69", { a: 6377295.664, rf: 300.8017 }],
  [7018, "evrst48", { a: 6377304.063, rf: 300.8017 }],
  [7042, "evrstSS", { a: 6377298.556, rf: 300.8017 }],
  [7049, "IAU76", { a: 6378140, rf: 298.257 }],
  [7020, "helmert", { a: 6378200, rf: 298.3 }],
  [7022, "intl", { a: 6378388, rf: 297 }],
  [7024, "krass", { a: 6378245, rf: 298.3 }],
  [7036, "GRS67", { a: 6378160, rf: 298.247167427 }],
  [7043, "WGS72", { a: 6378135, rf: 298.26 }],
  [7048, "sphere", { a: 6370997, rf: 0 }],
  [1024, "CGCS2000", { a: 6378137, rf: 298.257222101 }],
  [7054, "PZ90", { a: 6378136, rf: 298.257839303 }],
  [1025, "GSK2011", { a: 6378136.5, rf: 298.2564151 }],
];

/** Figure of an ellipsoid by its EPSG code (70xx). */
export function ellipsoidByCode(code: number): Figure | undefined {
  return TABLE.find((row) => row[0] === code)?.[2];
}

/** Figure of PROJ's `+ellps=`; proj4js would take WGS 84 for a name that it does not know. */
export function ellipsoidByProjName(name: string): Figure | undefined {
  return TABLE.find((row) => row[1] === name)?.[2];
}

/** Same figure within what texts lose by rounding; GRS 80 and WGS 84 count as one (0.1 mm apart at the pole). */
export function isGeocentricFigure({ a, rf }: Figure): boolean {
  return Math.abs(a - WGS84_FIGURE.a) < 2 && Math.abs(rf - WGS84_FIGURE.rf) < 0.002;
}

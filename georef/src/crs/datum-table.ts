/**
 * A datum's way to WGS 84, for CRS texts that name the datum but no shift. `towgs84`: metres, arc-seconds,
 * parts per million, position vector convention (PROJ's `+towgs84`; rotations of EPSG method 9607 with their signs
 * turned).
 */
export interface DatumShift {
  /** EPSG code of the datum (WKT1 `DATUM` authority, GeoTIFF GeogGeodeticDatum). */
  readonly code: number;
  /** EPSG code of the transformation. */
  readonly operation: number;
  readonly accuracy: number;
  readonly towgs84: readonly number[];
  /** EPSG name first, then the names of GDAL's and ESRI's WKT1. */
  readonly names: readonly string[];
}

/** Datum code, operation code, accuracy in metres, `+towgs84`, names. */
type Row = readonly [number, number, number, readonly number[], readonly string[]];

/**
 * Datums with a shift, by EPSG code. Where EPSG lists several transformations it is the one that PROJ 9.5 uses over
 * most of the datum's land when it has no grids (NAD83(HARN): the conterminous states); parameters and accuracies are those
 * of EPSG v11; what that is worth in the parts of a datum's area stands in datum-spread.ts. Datums whose
 * transformations differ from country to country (Pulkovo 1942(58) and (83)) are left out.
 */
const SHIFTED: readonly Row[] = [
  [6149, 1766, 1.5, [674.374, 15.056, 405.346], ["CH1903"]],
  [6150, 1676, 1, [674.374, 15.056, 405.346], ["CH1903+"]],
  [6314, 1777, 3, [598.1, 73.7, 418.2, 0.202, 0.045, -2.455, 6.7], ["Deutsches Hauptdreiecksnetz", "DHDN"]],
  [
    6312,
    1618,
    1.5,
    [577.326, 90.129, 463.919, 5.137, 1.474, 5.297, 2.4232],
    ["Militar-Geographische Institut", "MGI"],
  ],
  [
    6289,
    4833,
    1,
    [565.4171, 50.3319, 465.5524, -0.398957388243134, 0.343987817378283, -1.87740163998045, 4.0725],
    ["Amersfoort"],
  ],
  [
    6313,
    15929,
    1,
    [-106.8686, 52.2978, -103.7239, 0.3366, -0.457, 1.8422, -1.2747],
    ["Reseau National Belge 1972", "Belge 1972"],
  ],
  [
    6277,
    1314,
    2,
    [446.448, -125.157, 542.06, 0.15, 0.247, 0.842, -20.489],
    ["Ordnance Survey of Great Britain 1936", "OSGB 1936", "OSGB36"],
  ],
  [6299, 1641, 1, [482.5, -130.6, 564.6, -1.042, -0.214, -0.631, 8.15], ["TM65"]],
  [6300, 1954, 1, [482.5, -130.6, 564.6, -1.042, -0.214, -0.631, 8.15], ["Geodetic Datum of 1965", "TM75"]],
  [6188, 1955, 1, [482.5, -130.6, 564.6, -1.042, -0.214, -0.631, 8.15], ["OSNI 1952"]],
  [
    6156,
    5239,
    1,
    [572.213, 85.334, 461.94, 4.9732, 1.529, 5.2484, 3.5378],
    ["System of the Unified Trigonometrical Cadastral Network", "S-JTSK"],
  ],
  [
    1052,
    5227,
    1,
    [572.213, 85.334, 461.94, 4.9732, 1.529, 5.2484, 3.5378],
    ["System of the Unified Trigonometrical Cadastral Network/05", "S-JTSK/05"],
  ],
  [
    1201,
    8368,
    1,
    [485.021, 169.465, 483.839, 7.786342, 4.397554, 4.102655, 0],
    ["System of the Unified Trigonometrical Cadastral Network [JTSK03]", "JTSK03"],
  ],
  [6230, 1133, 10, [-87, -98, -121], ["European Datum 1950", "European 1950"]],
  [6207, 1988, 2, [-288.885, -91.744, 126.244, -1.691, 0.41, -0.211, -4.598], ["Lisbon 1937", "Lisbon"]],
  [6274, 1987, 1, [-239.749, 88.181, 30.488, 0.263, 0.082, 1.211, 2.229], ["Datum 73"]],
  [6275, 1193, 2, [-168, -60, 320], ["Nouvelle Triangulation Francaise", "NTF"]],
  [
    6272,
    1564,
    4,
    [59.47, -5.04, 187.44, 0.47, -0.1, 1.024, -4.5993],
    ["New Zealand Geodetic Datum 1949", "New Zealand 1949"],
  ],
  [6237, 1242, 1, [52.17, -71.82, -14.9], ["Hungarian Datum 1972", "Hungarian 1972"]],
  [6124, 1896, 1, [414.1, 41.3, 603.1, -0.855, 2.141, -7.023, 0], ["Rikets koordinatsystem 1990", "RT 1990"]],
  [6273, 1654, 3, [278.3, 93, 474.5, 7.889, 0.05, -6.61, 6.21], ["NGO 1948"]],
  [
    6123,
    10099,
    1,
    [-96.062, -82.428, -121.753, 4.801, 0.345, -1.376, 1.496],
    ["Kartastokoordinaattijarjestelma (1966)", "KKJ"],
  ],
  [6265, 1660, 4, [-104.1, -49.1, -9.9, 0.971, -2.917, 0.714, -11.68], ["Monte Mario"]],
  [6121, 1272, 1, [-199.87, 74.79, 246.62], ["Greek Geodetic Reference System 1987", "GGRS 1987"]],
  [1031, 3962, 5, [682, -203, 480], ["MGI 1901"]],
  [6141, 9676, 0.5, [23.772, 17.49, 17.859, -0.3132, -1.85274, 1.67299, -5.4262], ["Israel 1993", "Israel"]],
  [6284, 5044, 3, [23.57, -140.95, -79.8, 0, 0.35, 0.79, -0.22], ["Pulkovo 1942"]],
  [6200, 5043, 1, [24.47, -130.89, -81.56, 0, 0, 0.13, -0.22], ["Pulkovo 1995"]],
  [6322, 1238, 2, [0, 0, 4.5, 0, 0, 0.554, 0.219], ["World Geodetic System 1972", "WGS 1972"]],
  [6267, 1173, 10, [-8, 160, 176], ["North American Datum 1927", "North American 1927"]],
  [6301, 15484, 9, [-146.414, 507.337, 680.507], ["Tokyo"]],
  [
    6611,
    1825,
    1,
    [-162.619, -276.959, -161.764, 0.067753, -2.243648, -1.158828, -1.094246],
    ["Hong Kong 1980"],
  ],
  [
    6152,
    1901,
    1,
    [-0.991, 1.9072, 0.5129, 0.0257899075194932, 0.0096500989602704, 0.0116599432323421, 0],
    [
      "NAD83 (High Accuracy Reference Network)",
      "NAD83 High Accuracy Regional Network",
      "North American 1983 HARN",
    ],
  ],
  [
    6140,
    1946,
    1,
    [-0.991, 1.9072, 0.5129, 0.0257899075194932, 0.0096500989602704, 0.0116599432323421, 0],
    ["NAD83 Canadian Spatial Reference System", "North American 1983 CSRS"],
  ],
];

/** Geocentric datums that EPSG holds equal to WGS 84 within the stated accuracy: no shift. */
const GEOCENTRIC: readonly (readonly [number, number, number, readonly string[]])[] = [
  [6326, 0, 2, ["World Geodetic System 1984", "World Geodetic System 1984 ensemble", "WGS 1984"]],
  [
    6258,
    1149,
    1,
    [
      "European Terrestrial Reference System 1989",
      "European Terrestrial Reference System 1989 ensemble",
      "ETRS 1989",
    ],
  ],
  [6269, 1188, 4, ["North American Datum 1983", "North American 1983"]],
  [6759, 15931, 2, ["NAD83 (National Spatial Reference System 2007)", "NAD 1983 NSRS2007"]],
  [1116, 9774, 2, ["NAD83 (National Spatial Reference System 2011)", "NAD 1983 2011"]],
  [6167, 1565, 1, ["New Zealand Geodetic Datum 2000", "NZGD 2000"]],
  [6283, 1150, 3, ["Geocentric Datum of Australia 1994", "GDA 1994"]],
  [1168, 8450, 3, ["Geocentric Datum of Australia 2020", "GDA2020"]],
  [6171, 1671, 1, ["Reseau Geodesique Francais 1993 v1", "Reseau Geodesique Francais 1993", "RGF 1993"]],
  [6151, 1511, 1, ["Swiss Terrestrial Reference System 1995", "CHTRF 1995"]],
  [6619, 1879, 1, ["SWEREF99"]],
  [6173, 1678, 1, ["IRENET95"]],
  [6180, 1649, 1, ["Estonia 1997"]],
  [6661, 1958, 1, ["Latvian geodetic coordinate system 1992", "Latvia 1992"]],
  [6126, 1283, 1, ["Lithuania 1994 (ETRS89)", "Lithuania 1994"]],
  [6659, 1952, 1, ["Islands Net 1993", "Islands Network 1993"]],
  [6670, 1099, 1, ["Istituto Geografico Militaire 1995", "IGM 1995"]],
  [1132, 6711, 1, ["Rete Dinamica Nazionale 2008"]],
  [6765, 15976, 1, ["Slovenia Geodetic Datum 1996"]],
  [6761, 15967, 1, ["Croatian Terrestrial Reference System"]],
  [6148, 1505, 1, ["Hartebeesthoek94", "Hartebeesthoek 1994"]],
  [6612, 1826, 1, ["Japanese Geodetic Datum 2000", "JGD 2000"]],
  [1128, 9936, 1, ["Japanese Geodetic Datum 2011", "JGD 2011"]],
  [6737, 15831, 1, ["Korean Geodetic Datum 2002", "Korea 2000"]],
  [1026, 3830, 1, ["Taiwan Datum 1997", "TWD 1997"]],
  [6674, 15894, 1, ["Sistema de Referencia Geocentrico para las AmericaS 2000", "SIRGAS 2000"]],
  [6686, 15738, 1, ["Marco Geocentrico Nacional de Referencia", "MAGNA"]],
];

const NONE = [0, 0, 0] as const;

/** All datums with a way to WGS 84. */
export const DATUM_SHIFTS: readonly DatumShift[] = [
  ...SHIFTED,
  ...GEOCENTRIC.map(([code, operation, accuracy, names]): Row => [code, operation, accuracy, NONE, names]),
].map(([code, operation, accuracy, towgs84, names]) => ({ code, operation, accuracy, towgs84, names }));

/** `D_North_American_1983_HARN`, `NAD83 (HARN)` … reduced to what spellings share; the + of CH1903+ has meaning. */
function plain(name: string): string {
  return name
    .replace(/^D_/, "")
    .toLowerCase()
    .replace(/[^a-z0-9+]/g, "");
}

const BY_NAME: ReadonlyMap<string, DatumShift> = new Map(
  DATUM_SHIFTS.flatMap((shift) => shift.names.map((name) => [plain(name), shift] as const)),
);

/** The shift of a datum, by EPSG code if it has one, else by name. */
export function findDatumShift(name: string, code?: number): DatumShift | undefined {
  return DATUM_SHIFTS.find((shift) => shift.code === code) ?? BY_NAME.get(plain(name));
}

/** A shift if it is a translation alone, else undefined. */
export function translation(towgs84: readonly number[] | undefined): readonly number[] | undefined {
  return towgs84?.slice(3).every((value) => value === 0) ? towgs84.slice(0, 3) : undefined;
}

/** A datum of PROJ's `+datum=`: its ellipsoid, and its shift unless the table above has the datum under `name`. */
interface ProjDatum {
  readonly ellps: string;
  readonly name?: string;
  readonly towgs84?: readonly number[];
}

/** Datums of PROJ's `+datum=` (PROJ, datums.cpp); NAD27 is not here, PROJ computes it from grids alone. */
export const PROJ_DATUMS: ReadonlyMap<string, ProjDatum> = new Map<string, ProjDatum>([
  ["WGS84", { ellps: "WGS84", name: "World Geodetic System 1984" }],
  ["NAD83", { ellps: "GRS80", name: "North American Datum 1983" }],
  ["GGRS87", { ellps: "GRS80", towgs84: [-199.87, 74.79, 246.62] }],
  ["potsdam", { ellps: "bessel", towgs84: [598.1, 73.7, 418.2, 0.202, 0.045, -2.455, 6.7] }],
  ["carthage", { ellps: "clrk80ign", towgs84: [-263, 6, 431] }],
  ["hermannskogel", { ellps: "bessel", towgs84: [577.326, 90.129, 463.919, 5.137, 1.474, 5.297, 2.4232] }],
  ["ire65", { ellps: "mod_airy", towgs84: [482.53, -130.596, 564.557, -1.042, -0.214, -0.631, 8.15] }],
  ["nzgd49", { ellps: "intl", towgs84: [59.47, -5.04, 187.44, 0.47, -0.1, 1.024, -4.5993] }],
  ["OSGB36", { ellps: "airy", towgs84: [446.448, -125.157, 542.06, 0.1502, 0.247, 0.8421, -20.4894] }],
]);

import type { ConversionModel, HorizontalModel, ParameterId } from "./model.js";
import { letters } from "./parameters.js";
import { unsupported } from "./refusal.js";
import { WEB_MERCATOR } from "./web-mercator.js";

/** Parameters of a projection with the defaults of WKT: 0, and 1 for the scale. */
class Parameters {
  readonly #values: ReadonlyMap<ParameterId, number>;

  constructor({ parameters }: ConversionModel) {
    this.#values = parameters;
  }

  get(id: ParameterId): number {
    return this.#values.get(id) ?? (id === "scale" ? 1 : 0);
  }

  has(id: ParameterId): boolean {
    return this.#values.has(id);
  }

  /** `+key=value` for each pair; every projection ends with its false origin. */
  proj(name: string, ...pairs: (readonly [key: string, value: number | ParameterId])[]): string {
    const all = [...pairs, ["x_0", "falseEasting"] as const, ["y_0", "falseNorthing"] as const];
    const texts = all.map(([key, value]) => `+${key}=${typeof value === "number" ? value : this.get(value)}`);
    return [`+proj=${name}`, ...texts].join(" ");
  }
}

type Build = (p: Parameters) => string;

const LAT_LON = [
  ["lat_0", "latitudeOrigin"],
  ["lon_0", "longitudeOrigin"],
] as const;
const SCALE = ["k", "scale"] as const;
const PARALLELS = [
  ["lat_1", "standardParallel1"],
  ["lat_2", "standardParallel2"],
] as const;

const transverseMercator: Build = (p) => p.proj("tmerc", ...LAT_LON, SCALE);

/** ESRI writes both kinds under one name; the second parallel tells them apart. */
const lambertConformal: Build = (p) =>
  p.has("standardParallel2")
    ? p.proj("lcc", ...LAT_LON, ...PARALLELS, SCALE)
    : p.proj(
        "lcc",
        ["lat_1", p.has("standardParallel1") ? "standardParallel1" : "latitudeOrigin"],
        ...LAT_LON,
        SCALE,
      );

const stereographicAlternative: Build = (p) => p.proj("sterea", ...LAT_LON, SCALE);

/** Scale at the pole (EPSG 9810). */
const polarA: Build = (p) => {
  const pole = p.get("latitudeOrigin");
  if (Math.abs(pole) !== 90)
    throw unsupported(`a polar stereographic projection has its origin at latitude ${pole}`);
  return p.proj("stere", ...LAT_LON, SCALE);
};

/** True at a parallel (EPSG 9829); at the pole itself it is variant A with scale 1. */
function polarB(p: Parameters, parallel: number): string {
  if (p.get("scale") !== 1)
    throw unsupported("a polar stereographic projection has both a true parallel and a scale");
  const pole = parallel < 0 ? -90 : 90;
  if (Math.abs(parallel) === 90)
    return p.proj("stere", ["lat_0", pole], ["lon_0", "longitudeOrigin"], ["k", 1]);
  return p.proj("stere", ["lat_0", pole], ["lat_ts", parallel], ["lon_0", "longitudeOrigin"]);
}

/** WKT1 has one name for both variants; latitude_of_origin is then the pole or the true parallel. */
const polarWkt1: Build = (p) =>
  Math.abs(p.get("latitudeOrigin")) === 90 ? polarA(p) : polarB(p, p.get("latitudeOrigin"));

/** Swiss grids are written as oblique Mercator with azimuth 90°, which proj4js's omerc gets 6 cm wrong. */
const obliqueCenter: Build = (p) => {
  const azimuth = p.get("azimuth");
  const angle = gridAngle(p);
  if (azimuth === 90 && angle === 90) return p.proj("somerc", ...LAT_LON, ["k_0", "scale"]);
  return p.proj("omerc", ...OBLIQUE, ["gamma", angle], SCALE);
};

const obliqueOrigin: Build = (p) => `${p.proj("omerc", ...OBLIQUE, ["gamma", gridAngle(p)], SCALE)} +no_uoff`;

const OBLIQUE = [
  ["lat_0", "latitudeOrigin"],
  ["lonc", "longitudeOrigin"],
  ["alpha", "azimuth"],
] as const;

function gridAngle(p: Parameters): number {
  return p.has("gridAngle") ? p.get("gridAngle") : p.get("azimuth");
}

const swiss: Build = (p) => p.proj("somerc", ...LAT_LON, ["k_0", "scale"]);

/**
 * East-north Krovak (EPSG 1041). EPSG's south-west one (9819) is refused by its axes; ESRI tells them apart by
 * scale and rotation. PROJ and proj4js have the cone's azimuth and pseudo parallel built in.
 */
const krovak: Build = (p) => {
  const azimuth = p.get("azimuth");
  const esri = p.has("planeRotation") || p.has("xScale") || p.has("yScale");
  const northUp = !esri || (p.get("xScale") === -1 && p.get("yScale") === 1 && p.get("planeRotation") === 90);
  const classic = Math.abs(azimuth - 30.28813975) < 1e-5 && p.get("pseudoParallel") === 78.5;
  if (!northUp || !classic)
    throw unsupported("its Krovak projection is not the one orientated east and north");
  return p.proj("krovak", ...LAT_LON, ["alpha", azimuth], SCALE);
};

const mercatorA: Build = (p) => {
  if (p.get("latitudeOrigin") !== 0)
    throw unsupported("a Mercator projection has its origin off the equator");
  return p.proj("merc", ["lon_0", "longitudeOrigin"], SCALE);
};

/** True at a parallel; ESRI and EPSG 9805 name it as their standard parallel. */
const mercatorB: Build = (p) =>
  p.get("latitudeOrigin") === 0
    ? p.proj("merc", ["lat_ts", "standardParallel1"], ["lon_0", "longitudeOrigin"])
    : mercatorA(p);

const webMercator: Build = (p) => {
  const plain = [
    ...[
      "latitudeOrigin",
      "longitudeOrigin",
      "falseEasting",
      "falseNorthing",
      "standardParallel1",
      "auxiliarySphere",
    ],
  ] as const;
  if (!plain.every((id) => p.get(id as ParameterId) === 0))
    throw unsupported("its Pseudo-Mercator is shifted");
  return WEB_MERCATOR;
};

const equalAreaAzimuthal: Build = (p) => p.proj("laea", ...LAT_LON);
const equalAreaConic: Build = (p) => p.proj("aea", ...LAT_LON, ...PARALLELS);
const equidistantConic: Build = (p) => p.proj("eqdc", ...LAT_LON, ...PARALLELS);
const polyconic: Build = (p) => p.proj("poly", ...LAT_LON);
const newZealand: Build = (p) => p.proj("nzmg", ...LAT_LON);

interface Method {
  readonly codes: readonly number[];
  readonly names: readonly string[];
  readonly build: Build;
}

/** Projections by EPSG method code and by their names in WKT2 and the dialects of WKT1, letters only. */
const METHODS: readonly Method[] = [
  { codes: [9807], names: ["transversemercator", "gausskruger"], build: transverseMercator },
  {
    ...{ codes: [9801, 9802], build: lambertConformal },
    names: [
      ...["lambertconformalconic1sp", "lambertconformalconic2sp", "lambertconformalconic"],
      ...["lambertconicconformal1sp", "lambertconicconformal2sp"],
    ],
  },
  { codes: [9809], names: ["obliquestereographic", "doublestereographic"], build: stereographicAlternative },
  { codes: [9810], names: ["polarstereographicvarianta"], build: polarA },
  {
    ...{ codes: [9829], names: ["polarstereographicvariantb"] },
    build: (p) => polarB(p, p.get(p.has("standardParallel") ? "standardParallel" : "standardParallel1")),
  },
  { codes: [], names: ["polarstereographic"], build: polarWkt1 },
  { codes: [], names: ["stereographic"], build: polarA },
  {
    ...{ codes: [], names: ["stereographicnorthpole", "stereographicsouthpole"] },
    build: (p) => polarB(p, p.get("standardParallel1")),
  },
  {
    ...{ codes: [9815], build: obliqueCenter },
    names: ["hotineobliquemercatorvariantb", "hotineobliquemercatorazimuthcenter", "obliquemercator"],
  },
  {
    ...{ codes: [9812], build: obliqueOrigin },
    names: [
      "hotineobliquemercatorvarianta",
      "hotineobliquemercator",
      "hotineobliquemercatorazimuthnaturalorigin",
    ],
  },
  { codes: [9814], names: ["swissobliquecylindrical", "swissobliquemercator"], build: swiss },
  { codes: [1041, 9819], names: ["krovak", "krovaknorthorientated"], build: krovak },
  { codes: [9804], names: ["mercator1sp", "mercatorvarianta"], build: mercatorA },
  { codes: [9805], names: ["mercator2sp", "mercatorvariantb", "mercator"], build: mercatorB },
  {
    ...{ codes: [1024], build: webMercator },
    names: ["popularvisualisationpseudomercator", "mercatorauxiliarysphere"],
  },
  { codes: [9820], names: ["lambertazimuthalequalarea"], build: equalAreaAzimuthal },
  { codes: [9822], names: ["albersconicequalarea", "albersequalarea", "albers"], build: equalAreaConic },
  { codes: [1119], names: ["equidistantconic"], build: equidistantConic },
  { codes: [9818], names: ["polyconic", "americanpolyconic"], build: polyconic },
  { codes: [9811], names: ["newzealandmapgrid"], build: newZealand },
];

/** EPSG codes of Web Mercator, which old WKT1 writes as a plain Mercator projection. */
const WEB_MERCATOR_CODES = [3857, 3785, 900913];

/**
 * CRSs that compute on a sphere although they stand on an ellipsoid (EPSG method 1027), which WKT1 cannot say: it
 * has the ellipsoidal projection in its place, 17 km off.
 */
const SPHERICAL_CODES = [9311];

/**
 * The map projection as PROJ parameters, without ellipsoid, unit and datum.
 * @throws Refusal CRS_UNSUPPORTED for projections that proj4js has not, or has wrong
 */
export function projectionOf(model: HorizontalModel): string {
  const { conversion, code, directions } = model;
  if (model.projection !== undefined) return model.projection;
  if (!conversion) throw unsupported(`"${model.name}" has no map projection`);
  if (code !== undefined && WEB_MERCATOR_CODES.includes(code)) return WEB_MERCATOR;
  if (code !== undefined && SPHERICAL_CODES.includes(code)) {
    throw unsupported(`"${model.name}" projects its ellipsoid as a sphere`);
  }
  const plain = letters(conversion.method);
  const method =
    METHODS.find(
      ({ codes }) => conversion.methodCode !== undefined && codes.includes(conversion.methodCode),
    ) ?? METHODS.find(({ names }) => names.includes(plain));
  if (!method) throw unsupported(`the map projection "${conversion.method}" is not supported`);
  if (plain === "krovak" && !conversion.parameters.has("planeRotation") && !directions.includes("east")) {
    throw unsupported(
      `"${model.name}" does not say that its axes run east and north, as Krovak's otherwise do not`,
    );
  }
  const projection = method.build(new Parameters(conversion));
  const polar = projection.includes("+proj=stere") || /\+lat_0=-?90\b/.test(projection);
  if (directions.includes("west") || (directions.includes("south") && !polar)) {
    throw unsupported(`the axes of "${model.name}" run ${directions.join(" and ")}, not east and north`);
  }
  return projection;
}

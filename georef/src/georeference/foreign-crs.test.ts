import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  type CrsSources,
  type Domain,
  deriveTransformation,
  exactTransform,
  fitPlacement,
  GromaError,
  placePoint,
  resolveCrs,
} from "../index.js";

/** How many CRSs are tried; 10⁶ of them take some minutes. */
const RUNS = Number(process.env.GROMA_FUZZ_RUNS ?? 3000);

/** Texts of CRSs as files have them: WKT1 and PROJ strings of the EPSG table, WKT2, PROJJSON. */
const TABLED = [2056, 28992, 32633, 2994, 2263, 5514, 3857, 4326, 5041, 31467, 27700, 3035, 2193, 4978, 7415];
const WKT2 =
  'BOUNDCRS[SOURCECRS[COMPOUNDCRS["a",PROJCRS["b",BASEGEOGCRS["c",DATUM["d",ELLIPSOID["Bessel",6377397.155,' +
  '299.1528128,LENGTHUNIT["metre",1]]],PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]]],' +
  'CONVERSION["e",METHOD["Lambert Conic Conformal (2SP)",ID["EPSG",9802]],PARAMETER["Latitude of false origin",39,' +
  'ANGLEUNIT["degree",0.0174532925199433],ID["EPSG",8821]],PARAMETER["Longitude of false origin",-122,' +
  'ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Latitude of 1st standard parallel",41],' +
  'PARAMETER["Latitude of 2nd standard parallel",40],PARAMETER["Easting at false origin",2000000]],CS[Cartesian,2],' +
  'AXIS["(E)",east,LENGTHUNIT["US survey foot",0.304800609601219]],AXIS["(N)",north]],VERTCRS["h",VDATUM["v"],' +
  'CS[vertical,1],AXIS["(H)",up,LENGTHUNIT["metre",1]],ID["EPSG",5773]]]],ABRIDGEDTRANSFORMATION["f",' +
  'METHOD["Position Vector transformation"],PARAMETER["X-axis translation",598.1],PARAMETER["Z-axis rotation",-2.4]]]';
const PROJJSON = JSON.stringify({
  type: "ProjectedCRS",
  name: "b",
  base_crs: {
    name: "c",
    datum: {
      name: "World Geodetic System 1984",
      ellipsoid: { name: "WGS 84", semi_major_axis: 6378137, inverse_flattening: 298.257223563 },
      prime_meridian: { name: "Paris", longitude: { value: 2.5969, unit: "degree" } },
    },
  },
  conversion: {
    name: "e",
    method: { name: "Transverse Mercator", id: { authority: "EPSG", code: 9807 } },
    parameters: [
      { name: "Longitude of natural origin", value: 15, unit: "degree" },
      { name: "Scale factor at natural origin", value: 0.9996, unit: "unity" },
      {
        name: "False easting",
        value: 5e5,
        unit: { type: "LinearUnit", name: "foot", conversion_factor: 0.3048 },
      },
    ],
  },
  coordinate_system: { subtype: "Cartesian", axis: [{ name: "E", direction: "east", unit: "metre" }] },
});
const texts = [
  WKT2,
  PROJJSON,
  ...TABLED.flatMap((code) => [lookup(code)?.wkt, lookup(code)?.proj4]).filter((text) => text !== undefined),
];

/** Names that a plain object would find something under. */
const FOREIGN = ["__proto__", "constructor", "toString", "hasOwnProperty", "valueOf"];
const odd = fc.constantFrom(
  ...[
    "0",
    "-0",
    "1",
    "-1",
    "90",
    "-90",
    "180",
    "360.5",
    "1e308",
    "1e-308",
    "-1e17",
    "NaN",
    "Infinity",
    "",
    "9802",
  ],
  ...FOREIGN,
);
const number = fc.oneof(odd, fc.double({ noNaN: true, min: -400, max: 400 }).map(String));

/** A text with a few of its numbers or words replaced, a part cut out or repeated, or two texts spliced. */
const mutated = fc
  .tuple(
    fc.constantFrom(...texts),
    fc.constantFrom(...texts),
    fc.array(fc.tuple(fc.nat(4), fc.nat(), fc.nat(60), number), { maxLength: 4 }),
  )
  .map(([text, other, changes]) =>
    changes.reduce((now, [kind, place, length, value]) => {
      const at = place % (now.length + 1);
      if (kind === 0) return now.slice(0, at) + now.slice(at + length);
      if (kind === 1) return now.slice(0, at) + now.slice(at, at + length) + now.slice(at);
      if (kind === 2) return now.slice(0, at) + other.slice(place % other.length);
      const words = [...now.matchAll(kind === 3 ? /-?\d+(\.\d+)?/g : /[A-Za-z_]{2,}/g)];
      const word = words[place % Math.max(1, words.length)];
      return word ? now.slice(0, word.index) + value + now.slice(word.index + word[0].length) : now;
    }, text),
  );

const PROJECTIONS =
  "longlat geocent utm tmerc etmerc lcc sterea stere somerc omerc krovak laea aea merc webmerc poly eqdc nzmg";
const keys = [
  "lat_0",
  "lat_1",
  "lat_2",
  "lat_ts",
  "lon_0",
  "lonc",
  "alpha",
  "gamma",
  "k",
  "k_0",
  "x_0",
  "y_0",
];
const named = ["datum", "ellps", "units", "pm", "axis", "vunits", "nadgrids", "geoidgrids", "title"];
const names = fc.constantFrom(
  ...[
    "WGS84",
    "NAD83",
    "potsdam",
    "bessel",
    "GRS80",
    "us-ft",
    "ft",
    "paris",
    "enu",
    "neu",
    "@null",
    ...FOREIGN,
  ],
);
const sizes = ["zone", "a", "b", "rf", "f", "R", "to_meter", "vto_meter", "towgs84"];
/** PROJ strings of every projection with any parameters. */
const projString = fc
  .tuple(
    fc.constantFrom(...PROJECTIONS.split(" "), ...FOREIGN),
    fc.array(fc.tuple(fc.constantFrom(...keys), number), { maxLength: 6 }),
    fc.array(fc.tuple(fc.constantFrom(...named), names), { maxLength: 3 }),
    fc.array(
      fc.tuple(fc.constantFrom(...sizes), fc.oneof(number, fc.constantFrom("33", "6378137", "1,2,3"))),
      {
        maxLength: 2,
      },
    ),
    fc.subarray(["+south", "+no_uoff", "+no_defs"]),
  )
  .map(([projection, ...pairs]) => {
    const words = pairs.flat().map((pair) => (typeof pair === "string" ? pair : `+${pair[0]}=${pair[1]}`));
    return [`+proj=${projection}`, ...words].join(" ");
  });

const keyIds = [
  1024, 1026, 2048, 2049, 2050, 2054, 2056, 2057, 2058, 2059, 2061, 2062, 3072, 3073, 3074, 3075, 3076,
];
const parameterIds = [
  3077, 3078, 3079, 3080, 3081, 3082, 3083, 3084, 3085, 3088, 3089, 3092, 3095, 4096, 4099,
];
/** GeoTIFF key directories: known keys with any values, and directories cut short. */
const geoTiff = fc
  .tuple(
    fc.array(
      fc.tuple(
        fc.constantFrom(...keyIds, ...parameterIds),
        fc.constantFrom(0, 0, 34736, 34737, 7),
        fc.nat(8),
        fc.oneof(fc.constantFrom(...TABLED, 1, 2, 3, 32767, 16033, 9001, 9003, 9102, 5773), fc.nat(65535)),
      ),
      { maxLength: 12 },
    ),
    fc.array(fc.double(), { maxLength: 9 }),
    fc.nat(30),
  )
  .map(([entries, doubles, stated]) => ({
    directory: Uint16Array.from([1, 1, 0, stated, ...entries.flat()]),
    doubles: Float64Array.from(doubles),
    ascii: "constructor|__proto__|NAD83|",
  }));

const sources: fc.Arbitrary<Omit<CrsSources, "file">> = fc.oneof(
  mutated.map((given) => ({ given })),
  mutated.map((wkt) => ({ wkt })),
  projString.map((given) => ({ given })),
  geoTiff.map((keys) => ({ geoTiff: keys })),
);

const coordinate = fc.oneof(
  fc.double({ min: -3e7, max: 3e7, noNaN: true }),
  fc.double({ min: -200, max: 200, noNaN: true }),
  fc.constantFrom(0, 90, -90, 180, -180, 5e5, 2e6, 1e300, Number.NaN, Number.POSITIVE_INFINITY),
);
const size = fc.constantFrom(0, 0, 1e-9, 1, 100, 1e4, 1e7, -1, Number.NaN);
/** Nodes anywhere: over poles and the antimeridian, of no size, inside out, not numbers. */
const domains: fc.Arbitrary<Domain> = fc
  .tuple(coordinate, coordinate, coordinate, size, size)
  .map(([minX, minY, minZ, plan, height]) => {
    return { minX, minY, minZ, maxX: minX + plan, maxY: minY + plan, maxZ: minZ + height };
  });

/** The code of the error, or that it has worked; what is not one of the project's errors is thrown on. */
async function outcome(task: () => unknown): Promise<string> {
  try {
    await task();
    return "done";
  } catch (error) {
    if (error instanceof GromaError && /^(CRS|PLACE)_[A-Z]+$/.test(error.code)) return error.code;
    throw error;
  }
}

describe("a CRS of a file that is not to be trusted", () => {
  it("is fitted with a bound or refused by name, wherever the points are", {
    timeout: 3_600_000,
  }, async () => {
    const seen = new Map<string, number>();
    await fc.assert(
      fc.asyncProperty(sources, domains, fc.integer({ min: 0, max: 199 }), async (source, domain, one) => {
        const code = await outcome(async () => {
          const crs = resolveCrs({ file: "foreign.las", ...source }, lookup);
          const truth = exactTransform(crs, domain.minZ);
          placePoint(truth, domain.minX, domain.minY, domain.minZ, new Float64Array(3), "foreign.las");
          const placement = fitPlacement(truth, domain, 0.001, "foreign.las");
          expect(placement.bound).toBeGreaterThan(0);
          expect(Number.isFinite(placement.bound)).toBe(true);
          expect(placement.coefficients.every(Number.isFinite)).toBe(true);
          if (one === 0) await deriveTransformation(crs, domain);
        });
        seen.set(code, (seen.get(code) ?? 0) + 1);
      }),
      { numRuns: RUNS },
    );
    console.info(`${RUNS} foreign CRSs: ${[...seen].map(([code, count]) => `${code} ${count}`).join(", ")}`);
    for (const code of ["done", "CRS_UNKNOWN", "CRS_UNSUPPORTED", "PLACE_DOMAIN"]) {
      expect(seen.get(code) ?? 0).toBeGreaterThan(0);
    }
  });

  it("may be a PROJ string in a record, which goes to proj4js as it is", async () => {
    const METRE = { name: "metre", kind: "linear", size: 1 } as const;
    await fc.assert(
      fc.asyncProperty(projString, domains, async (proj4, domain) => {
        const crs = {
          ...{ proj4, horizontalUnit: METRE, verticalUnit: { ...METRE, declared: true } },
          height: { kind: "unknown" } as const,
        };
        await outcome(() => fitPlacement(exactTransform(crs), domain, 0.001));
      }),
      { numRuns: RUNS },
    );
  });

  it("has no place under a cone without a slope: PLACE_DOMAIN, not a TypeError", async () => {
    const crs = resolveCrs({ file: "te.las", given: "+proj=lcc +lat_1=0 +lat_0=0 +lon_0=0 +datum=WGS84" });
    const truth = exactTransform(crs);
    const domain = { minX: 6e6, maxX: 6.1e6, minY: 2e6, maxY: 2.1e6, minZ: 0, maxZ: 1 };
    const point = () => placePoint(truth, 6e6, 2e6, 0, new Float64Array(3), "te.las");
    expect(await outcome(point)).toBe("PLACE_DOMAIN");
    expect(await outcome(() => fitPlacement(truth, domain, 0.001))).toBe("PLACE_DOMAIN");
    expect(await outcome(() => deriveTransformation(crs, domain))).toBe("PLACE_DOMAIN");
  });

  it.each(["1e308", "1e-300", "-1", "0", "3e8"])("has no unit of %s m", async (size) => {
    for (const key of ["to_meter", "vto_meter"]) {
      const given = `+proj=utm +zone=33 +datum=WGS84 +${key}=${size}`;
      expect(await outcome(() => resolveCrs({ file: "foreign.las", given }))).toBe("CRS_UNKNOWN");
    }
  });

  it("has no place for points whose distances overflow: PLACE_DOMAIN", async () => {
    const truth = exactTransform(resolveCrs({ file: "foreign.las", given: "EPSG:4326" }, lookup));
    const domain = { minX: 0, minY: 0, minZ: 0, maxX: 0, maxY: 0, maxZ: 1e300 };
    expect(await outcome(() => fitPlacement(truth, domain, 0.001))).toBe("PLACE_DOMAIN");
  });

  it.each(FOREIGN)("does not find %s in any table", async (name) => {
    const refused = async (given: string) => {
      const code = await outcome(() => resolveCrs({ file: "foreign.las", given }, lookup));
      expect(["CRS_UNKNOWN", "CRS_UNSUPPORTED"]).toContain(code);
    };
    await refused(`+proj=${name}`);
    await refused(`+proj=longlat +datum=${name}`);
    await refused(`+proj=longlat +ellps=${name}`);
    await refused(`+proj=longlat +datum=WGS84 +pm=${name}`);
    await refused(`+proj=utm +zone=33 +datum=WGS84 +units=${name}`);
    await refused(PROJJSON.replace("ProjectedCRS", name));
    await refused(PROJJSON.replace('"unit":"degree"', `"unit":"${name}"`));
  });
});

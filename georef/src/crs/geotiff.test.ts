import { describe, expect, it } from "vitest";
import { distance } from "../cartesian/points.fixture.js";
import { exactTransform, type GeoTiffKeys, placePoint, resolveCrs } from "../index.js";
import { lookup } from "./epsg-table.fixture.js";

type Key = readonly [key: number, value: number | string | readonly number[]];

/** Key directory, doubles and text as a writer lays them out. */
function keysOf(keys: readonly Key[]): GeoTiffKeys {
  const directory = [1, 1, 0, keys.length];
  const doubles: number[] = [];
  let ascii = "";
  for (const [key, value] of keys) {
    if (typeof value === "number") directory.push(key, 0, 1, value);
    else if (typeof value === "string") {
      directory.push(key, 34737, value.length + 1, ascii.length);
      ascii += `${value}|`;
    } else {
      directory.push(key, 34736, value.length, doubles.length);
      doubles.push(...value);
    }
  }
  return { directory: Uint16Array.from(directory), doubles: Float64Array.from(doubles), ascii };
}

const read = (...keys: Key[]) => resolveCrs({ file: "scan.las", geoTiff: keysOf(keys) }, lookup);
const UTM17: Key[] = [
  [1024, 1],
  [1025, 1],
  [3072, 32617],
  [3076, 9001],
];

/** Oregon Lambert as Watershed Sciences wrote it: everything user-defined, feet, false easting in feet. */
const OREGON: Key[] = [
  [1024, 1],
  [2048, 32767],
  [2050, 6152],
  [2054, 9102],
  [2057, [6378137]],
  [2059, [298.257222101]],
  [3072, 32767],
  [3073, "NAD_1983_HARN_Lambert_Conformal_Conic"],
  [3074, 32767],
  [3075, 8],
  [3076, 9002],
  [3078, [43]],
  [3079, [45.5]],
  [3084, [-120.5]],
  [3085, [41.75]],
  [3086, [1312335.958005249]],
  [3087, [0]],
];

describe("GeoTIFF keys", () => {
  it("read EPSG codes", () => {
    expect(read(...UTM17)).toMatchObject({
      code: "EPSG:32617",
      height: { kind: "unknown" },
      verticalUnit: { size: 1 },
    });
    expect(read([1024, 2], [2048, 4326], [2054, 9102])).toMatchObject({ code: "EPSG:4326" });
  });

  it("read user-defined projections: the same place as the WKT of the same CRS", () => {
    const keys = read(...OREGON);
    const wkt = resolveCrs({ file: "f", given: "EPSG:2994" }, lookup);
    const [a, b] = [new Float64Array(3), new Float64Array(3)];
    placePoint(exactTransform(keys), 637000, 850000, 400, a);
    placePoint(exactTransform(wkt), 637000, 850000, 400, b);
    // Half a micrometre of it is the false easting, given to nine places here and to three there.
    expect(distance(a, b)).toBeLessThan(1e-5);
    expect(keys.horizontalUnit.size).toBe(0.3048);
    expect(keys.name).toBe("NAD_1983_HARN_Lambert_Conformal_Conic");
  });

  it("read a UTM zone given as a projection", () => {
    const keys: Key[] = [...UTM17.slice(0, 2), [2048, 4326], [3072, 32767], [3074, 16117], [3076, 9001]];
    expect(read(...keys).proj4).toContain("+lon_0=-81 +k=0.9996 +x_0=500000 +y_0=10000000");
  });

  it("keep the unit of the file when it is not that of the code", () => {
    const crs = read([1024, 1], [3072, 32617], [3076, 9003]);
    expect(crs.horizontalUnit.size).toBe(1200 / 3937);
    expect(crs.proj4).toContain("+x_0=500000");
    expect(crs.proj4).toContain("+units=us-ft");
    // Whoever looked the code up would take feet for metres.
    expect([crs.code, crs.name]).toEqual([undefined, "WGS 84 / UTM zone 17N in US survey foot"]);
    const withHeights = read([1024, 1], [3072, 32617], [3076, 9003], [4096, 5703]);
    expect(withHeights).toMatchObject({
      height: { epsg: 5703 },
      name: expect.stringContaining(" in US survey foot + "),
    });
    expect(withHeights.code).toBeUndefined();
  });

  it("read vertical codes, old ones included, with the unit of the file", () => {
    expect(read(...UTM17, [4096, 5703]).height).toEqual({
      kind: "geoid",
      model: "NAVD88 height",
      epsg: 5703,
    });
    expect(read(...UTM17, [4096, 5103], [4099, 9003])).toMatchObject({
      height: { kind: "geoid", epsg: 5703 },
      verticalUnit: { size: 1200 / 3937, declared: true },
    });
    expect(read(...UTM17, [4096, 5030], [4099, 9001]).height).toEqual({ kind: "ellipsoidal" });
    expect(read(...UTM17, [4099, 9002])).toMatchObject({
      height: { kind: "unknown" },
      verticalUnit: { size: 0.3048, declared: true },
    });
  });

  it("bear empty and dangling entries, and more of them announced than there are", () => {
    const { directory, doubles, ascii } = keysOf(UTM17);
    const padded = Uint16Array.from([...directory, 0, 0, 0, 0, 2057, 34736, 3, 9000, 3073, 34737, 500, 9000]);
    padded[3] = 60000;
    expect(resolveCrs({ file: "f", geoTiff: { directory: padded, doubles, ascii } }, lookup).code).toBe(
      "EPSG:32617",
    );
  });

  it.each<[string, Key[], RegExp]>([
    ["no keys", [], /^CRS_MISSING/],
    ["keys that name no CRS", [[1025, 1]], /^CRS_MISSING/],
    [
      "a code that is not there",
      [
        [1024, 1],
        [3072, 31111],
      ],
      /^CRS_UNKNOWN: .*31111/,
    ],
    [
      "a projection by citation alone",
      [
        [1024, 1],
        [2048, 4326],
        [3072, 32767],
        [3073, "my grid"],
      ],
      /^CRS_UNSUPPORTED: .*none named/,
    ],
    [
      "an unknown projection",
      [
        [1024, 1],
        [2048, 4326],
        [3072, 32767],
        [3075, 27],
      ],
      /^CRS_UNSUPPORTED: .*\(27\)/,
    ],
    [
      "an unknown unit",
      [
        [1024, 1],
        [3072, 32617],
        [3076, 9099],
      ],
      /^CRS_UNSUPPORTED: .*linear unit 9099/,
    ],
  ])("refuse %s by name", (_, keys, pattern) => {
    expect(() => read(...keys)).toThrow(pattern);
  });
});

import { ellipsoid, geodeticToEcef, resolveCrs, WGS84 } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, radians } from "../../georef/src/cartesian/points.fixture.js";
import { lookup } from "../../georef/src/crs/epsg-table.fixture.js";
import { truth, withoutShift } from "./truth.js";

/** One CRS of `crs_formats.json`: coordinates on its own datum, computed by PROJ, and its notations. */
interface Row {
  readonly code: string;
  readonly name: string;
  readonly lon: readonly number[];
  readonly lat: readonly number[];
  readonly x: readonly number[];
  readonly y: readonly number[];
  readonly fmts: Readonly<Record<string, string | object | null>>;
}

const { rows, missing } = truth<Row>("crs_formats.json");

/** The ellipsoid of a normalised PROJ string; GRS 80 without a shift and Web Mercator count as WGS 84. */
function ellipsoidOf(proj4: string) {
  if (proj4.includes("+nadgrids=@null") || proj4.includes("+a=6378137 ")) return WGS84;
  const [, a] = /\+a=(\S+)/.exec(proj4) ?? [];
  const [, rf] = /\+rf=(\S+)/.exec(proj4) ?? [];
  return ellipsoid(Number(a), 1 / Number(rf));
}

function worst(row: Row, notation: string, text: string): number {
  const source = notation.startsWith("WKT") ? { wkt: text } : { given: text };
  const crs = resolveCrs({ file: row.code, ...source }, lookup);
  const exact = withoutShift(crs);
  const figure = ellipsoidOf(crs.proj4);
  const got = new Float64Array(6);
  const want = new Float64Array(3);
  let metres = 0;
  row.x.forEach((x, i) => {
    exact(x, row.y[i], got, 0);
    geodeticToEcef(radians(row.lon[i]), radians(row.lat[i]), 0, want, 0, figure);
    metres = Math.max(metres, distance(got, want));
  });
  return metres;
}

describe.skipIf(missing)(
  `23 CRSs in seven notations, the same place${missing ? ` (${missing})` : ""}`,
  () => {
    for (const row of rows) {
      const notations: [string, string][] = Object.entries(row.fmts)
        .filter(([, value]) => value)
        .map(([notation, value]) => [notation, typeof value === "string" ? value : JSON.stringify(value)]);
      notations.push(["EPSG", `EPSG:${row.code}`]);
      it.each(notations)(`EPSG:${row.code} ${row.name}, %s: ≤ 1 mm`, (notation, text) => {
        expect(worst(row, notation, text)).toBeLessThanOrEqual(0.001);
      });
    }

    it("has no notation left out but WKT1 GDAL of EPSG:4979, which cannot be written", () => {
      const empty = rows.flatMap((row) =>
        Object.entries(row.fmts)
          .filter(([, value]) => !value)
          .map(([key]) => `${row.code} ${key}`),
      );
      expect(empty).toEqual(["4979 WKT1_GDAL"]);
    });

    it("tells the two parts of compound CRSs apart in every notation", () => {
      for (const code of ["2263+6360", "2994+8228", "7415", "25832+7837"]) {
        const row = rows.find((candidate) => candidate.code === code)!;
        const { PROJ4: proj4, ...wkts } = row.fmts;
        for (const text of Object.values(wkts)) {
          const given = typeof text === "string" ? text : JSON.stringify(text);
          const crs = resolveCrs({ file: code, given }, lookup);
          expect(crs.height.kind).toBe("geoid");
          expect(crs.verticalUnit.declared).toBe(true);
          expect(crs.verticalUnit.size).toBe(crs.horizontalUnit.size);
        }
        // A PROJ string has the unit of the height but no word for its reference.
        const crs = resolveCrs({ file: code, given: String(proj4) });
        expect([crs.height.kind, crs.verticalUnit.declared]).toEqual(["unknown", true]);
      }
    });
  },
);

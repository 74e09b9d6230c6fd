import { readFileSync } from "node:fs";
import { geodesicBetween, geodesicFrom, geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, radians } from "../../georef/src/cartesian/points.fixture.js";
import { data } from "../project.js";

/** Metres between two places on the ellipsoid, in a straight line. */
function apart(lon1: number, lat1: number, lon2: number, lat2: number): number {
  const points = new Float64Array(6);
  geodeticToEcef(lon1, lat1, 0, points);
  geodeticToEcef(lon2, lat2, 0, points, 3);
  return distance(points.subarray(0, 3), points.subarray(3));
}

const { path, missing } = data("truth/geodtest.dat");

describe.skipIf(missing)(`Karney's test set${missing ? ` (${missing})` : ""}`, () => {
  it("all 3,000 rows within 15 nm, inverse and direct, both ways", () => {
    const rows = readFileSync(path, "utf8")
      .trim()
      .split("\n")
      .map((line) => line.split(" ").map(Number));
    expect(rows.length).toBe(3000);
    let inverse = 0;
    let direct = 0;
    for (const [lat1, lon1, azi1, lat2, lon2, azi2, s12] of rows) {
      const from = [radians(lon1), radians(lat1)] as const;
      const to = [radians(lon2), radians(lat2)] as const;
      const found = geodesicBetween(...from, ...to).distance;
      inverse = Math.max(inverse, Math.abs(found - s12));
      const end = geodesicFrom(...from, radians(azi1), s12);
      const start = geodesicFrom(...to, radians(azi2), -s12);
      direct = Math.max(direct, apart(end.longitude, end.latitude, ...to));
      direct = Math.max(direct, apart(start.longitude, start.latitude, ...from));
    }
    console.info(`inverse ${(inverse * 1e9).toFixed(1)} nm, direct ${(direct * 1e9).toFixed(1)} nm`);
    expect(inverse).toBeLessThanOrEqual(15e-9);
    expect(direct).toBeLessThanOrEqual(15e-9);
  });
});

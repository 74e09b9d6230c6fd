import { type Crs, exactTransform, fitPlacement, place, resolveCrs } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { readLasHeader } from "./las-header.js";

/** The CRS taken apart for PROJ: with the same parameters, but none of this project's arithmetic. */
function request(crs: Crs, points: readonly (readonly number[])[]): string {
  const take = (pattern: RegExp) => (crs.proj4.match(pattern) ?? []).join(" ");
  const shift = /\+towgs84=(\S+)/.exec(crs.proj4)?.[1].split(",").map(Number);
  return JSON.stringify({
    projection: take(/\+(?:proj|lat_\w+|lon_\w+|k|k_0|x_0|y_0|alpha|gamma|lonc)=\S+/g),
    ellipsoid: take(/\+(?:a|rf)=\S+/g),
    shift: shift ?? null,
    horizontal: crs.horizontalUnit.size,
    vertical: crs.verticalUnit.size,
    points,
  });
}

describe.each(["autzen.laz", "vol_total.laz"])(
  "placing %s against PROJ, given the same datum parameters",
  (name) => {
    const { path, missing } = data(name);
    const reason = pythonMissing ?? missing;

    it.skipIf(reason)(`1,000 random points: ≤ 1 mm${reason ? ` (${reason})` : ""}`, () => {
      const { domain, wkt } = readLasHeader(path);
      const { minX, minY, minZ, maxX, maxY, maxZ } = domain;
      const crs = resolveCrs({ file: name, wkt });
      const placement = fitPlacement(exactTransform(crs), domain, 0.001, name);

      const next = random(7);
      const points = Array.from({ length: 1000 }, () => [
        minX + (maxX - minX) * next(),
        minY + (maxY - minY) * next(),
        minZ + (maxZ - minZ) * next(),
      ]);
      const want = runPython<number[][]>("numerics/placing_referee.py", [], request(crs, points));
      const got = new Float64Array(3);
      let worst = 0;
      points.forEach(([x, y, z], i) => {
        place(placement, x, y, z, got);
        worst = Math.max(worst, distance(got, want[i]));
      });
      expect(want).toHaveLength(points.length);
      expect(worst).toBeLessThanOrEqual(0.001);
    });
  },
);

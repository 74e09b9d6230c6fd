import { exactTransform, fitPlacement, placeIntegers, placePoint, resolveCrs } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { distance, random } from "../../georef/src/cartesian/points.fixture.js";
import { data } from "../project.js";
import { readLasHeader } from "./las-header.js";

const SCANS = ["autzen.laz", "vol_total.laz"];

describe.each(SCANS)("placing %s", (name) => {
  const { path, missing } = data(name);

  it.skipIf(missing)(
    `1,000 random points, page's way against the exact one: ≤ 1 mm${missing ? ` (${missing})` : ""}`,
    () => {
      const { scale, offset, domain, wkt } = readLasHeader(path);
      const crs = resolveCrs({ file: name, wkt });
      const exact = exactTransform(crs);
      const placement = fitPlacement(exact, domain, 0.001, name);
      expect(placement.bound).toBeLessThanOrEqual(0.001);

      const next = random(20261122);
      const count = 1000;
      const { minX, minY, minZ, maxX, maxY, maxZ } = domain;
      const [low, high] = [
        [minX, minY, minZ],
        [maxX, maxY, maxZ],
      ];
      const xyz = Int32Array.from({ length: 3 * count }, (_, i) => {
        const axis = i % 3;
        return Math.round((low[axis] + (high[axis] - low[axis]) * next() - offset[axis]) / scale[axis]);
      });
      const local = new Float32Array(3 * count);
      placeIntegers(placement, xyz, count, scale, offset, local);

      const { origin, rotation: r } = placement.frame;
      const want = new Float64Array(3);
      let worst = 0;
      for (let i = 0; i < count; i++) {
        const [x, y, z] = [0, 1, 2].map((axis) => xyz[3 * i + axis] * scale[axis] + offset[axis]);
        placePoint(exact, x, y, z, want);
        const [e, n, u] = local.subarray(3 * i, 3 * i + 3);
        const got = [0, 1, 2].map((axis) => origin[axis] + r[axis] * e + r[axis + 3] * n + r[axis + 6] * u);
        worst = Math.max(worst, distance(got, want));
      }
      expect(worst).toBeLessThanOrEqual(placement.bound);
    },
  );
});

describe("what the scans say of themselves", () => {
  const read = (name: string) => {
    const { path, missing } = data(name);
    return missing === undefined ? resolveCrs({ file: name, wkt: readLasHeader(path).wkt }) : undefined;
  };

  it.skipIf(data("autzen.laz").missing)(
    "autzen.laz: international feet, height undeclared and so in feet too",
    () => {
      const crs = read("autzen.laz");
      expect(crs).toMatchObject({
        name: "NAD_1983_HARN_Lambert_Conformal_Conic",
        horizontalUnit: { name: "foot", size: 0.3048 },
        verticalUnit: { name: "foot", size: 0.3048, declared: false },
        height: { kind: "unknown" },
      });
      expect(crs?.code).toBeUndefined();
    },
  );

  it.skipIf(data("vol_total.laz").missing)("vol_total.laz: CH1903 / LV03 as somerc with its shift", () => {
    const crs = read("vol_total.laz");
    expect(crs).toMatchObject({ code: "EPSG:21781", height: { kind: "unknown" } });
    expect(crs?.proj4).toContain("+proj=somerc");
    expect(crs?.proj4).toContain("+towgs84=674.374,15.056,405.346");
  });
});

import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { settle } from "./globe.js";
import { openPage, sharedBrowser, type View, view } from "./harness.js";

interface Picked {
  key: string;
  index: number;
}

/** The scans with their CRS in PROJ's words: same projection and the same datum parameters as the page has. */
const scans = [
  {
    name: "autzen.laz",
    proj4:
      "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +y_0=0 +ellps=GRS80 " +
      // NAD83(HARN) to WGS 84 (3), EPSG:1901, rotations in the position vector convention.
      "+towgs84=-0.991,1.9072,0.5129,0.0257899075194932,0.0096500989602704,0.0116599432323421,0 +units=ft +no_defs",
    metresPerVerticalUnit: 0.3048,
  },
  {
    name: "vol_total.laz",
    proj4:
      "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=600000 +y_0=200000 +ellps=bessel " +
      "+towgs84=674.374,15.056,405.346,0,0,0,0 +units=m +no_defs",
    metresPerVerticalUnit: 1,
  },
];

const missing = scans.map((scan) => data(scan.name).missing).find(Boolean) ?? pythonMissing;

describe.skipIf(missing)(`places in the page against PROJ${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let browser: Browser;
  beforeAll(async () => {
    browser = await sharedBrowser();
  });
  afterAll(async () => {
    await browser?.close();
  });

  it.each(scans)(
    "1,000 random points of $name lie within 1 mm of PROJ's place",
    {
      timeout: 240_000,
    },
    async ({ name, proj4, metresPerVerticalUnit }) => {
      const copc = converted(data(name).path);
      const server: View = await view(copc);
      try {
        const picked = runPython<Picked[]>("browser/placing.py", ["choose", copc, "12", "1000"]);
        const { page, watch } = await openPage(browser, { width: 320, height: 240 });
        await page.goto(`${server.address}&budget=50000`);
        await settle(page);
        const placed = await page.evaluate(async (points) => {
          const { cloud } = window.groma.layer;
          const nodes = new Map<string, Awaited<ReturnType<typeof cloud.loadNode>>>();
          for (const key of new Set(points.map((point) => point.key)))
            nodes.set(key, await cloud.loadNode(key));
          return points.map(({ key, index }) => {
            const { positions, order, frame } = nodes.get(key)!;
            // The very float32 that the GPU gets, taken to ECEF by the node's float64 frame.
            const drawn = order.indexOf(index);
            const [east, north, up] = positions.subarray(3 * drawn, 3 * drawn + 3);
            const { origin, rotation } = frame;
            const ecef = [0, 1, 2].map(
              (axis) =>
                origin[axis] + rotation[axis] * east + rotation[axis + 3] * north + rotation[axis + 6] * up,
            );
            return { key, index, ecef };
          });
        }, picked);
        const args = ["check", copc, proj4, String(metresPerVerticalUnit)];
        const result = runPython<{ count: number; worst: number }>(
          "browser/placing.py",
          args,
          JSON.stringify(placed),
        );
        expect(result.count).toBe(1000);
        expect(result.worst).toBeLessThanOrEqual(0.001);
        expect(watch.errors).toEqual([]);
        await page.context().close();
      } finally {
        await server.stop();
      }
    },
  );
});

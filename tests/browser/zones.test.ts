import type { PointCloudLayer } from "@groma/layer/cesium";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { pythonMissing, runPython } from "../python.js";
import { settle } from "./globe.js";
import { openPage, sharedBrowser, type View, view } from "./harness.js";
import { type Twins, twins } from "./zones.js";

type Place = Twins["ecef"][number];

const distance = (a: Place, b: Place) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

describe.skipIf(pythonMissing)(
  `two zones in one scene${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let browser: Browser;
    const servers: View[] = [];

    beforeAll(async () => {
      browser = await sharedBrowser();
    });
    afterAll(async () => {
      await browser?.close();
      for (const server of servers) await server.stop();
    });

    it("draws twin points of UTM zones 31 and 32 within 1 mm of each other, and of PROJ's place", {
      timeout: 240_000,
    }, async () => {
      const { zones, ecef } = await twins();
      const files = zones.map(({ file }) => converted(file));
      for (const file of files) servers.push(await view(file));
      const [here, beside] = servers.map(({ address }) => new URL(address));
      const { page, watch } = await openPage(browser, { width: 480, height: 320 });
      await page.goto(here!.href);
      await settle(page);

      // The second cloud comes from a server of its own, as from another host.
      const second = new URL(beside!.searchParams.get("cloud")!, beside!).href;
      const nodes = files.map((file) => runPython<string[]>("browser/zones.py", ["nodes", file]));
      const [west, east] = await page.evaluate(
        async ([url, keys]) => {
          const { viewer, layer } = window.groma;
          const { fromUrl } = layer.constructor as typeof PointCloudLayer;
          const other: PointCloudLayer = viewer.scene.primitives.add(await fromUrl(url));
          /** ECEF of every vertex as the GPU gets it, at the place in the list that its intensity names. */
          const drawn = async ({ cloud }: PointCloudLayer, names: string[]) => {
            const places: [number, number, number][] = [];
            for (const name of names) {
              const { positions, columns, frame, count } = await cloud.loadNode(name);
              for (let point = 0; point < count; point++) {
                const place: [number, number, number] = [frame.origin[0], frame.origin[1], frame.origin[2]];
                for (const axis of [0, 1, 2] as const) {
                  for (const along of [0, 1, 2]) {
                    place[axis] += frame.rotation[3 * along + axis]! * positions[3 * point + along]!;
                  }
                }
                places[columns.get("intensity")!.data[point]!] = place;
              }
            }
            return places;
          };
          return [await drawn(layer, keys[0]), await drawn(other, keys[1])] as const;
        },
        [second, nodes as [string[], string[]]] as const,
      );

      expect([west.length, east.length]).toEqual([2000, 2000]);
      const apart = west.map((place, i) => distance(place, east[i]!));
      const off = [west, east].map((places) =>
        Math.max(...places.map((place, i) => distance(place, ecef[i]!))),
      );
      expect(Math.max(...apart)).toBeLessThanOrEqual(0.001);
      expect(Math.max(...off)).toBeLessThanOrEqual(0.001);
      // They were written in coordinates that have nothing in common.
      const names = await page.evaluate(() => {
        const { primitives } = window.groma.viewer.scene;
        const layers = Array.from({ length: primitives.length }, (_, i) => primitives.get(i));
        return layers.flatMap((layer) => (layer.cloud ? [layer.cloud.crs.name as string] : []));
      });
      expect(names).toEqual(["WGS 84 / UTM zone 31N", "WGS 84 / UTM zone 32N"]);
      expect(watch.errors).toEqual([]);
      expect(watch.foreign).toEqual([]);
      await page.context().close();
    });
  },
);

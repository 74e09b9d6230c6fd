import { readFileSync } from "node:fs";
import { PointCloud } from "@groma/layer";
import { afterEach, beforeAll, describe, expect, it, vi } from "vitest";
import { converted } from "../converted.js";
import { BadServer } from "../faults/bad-server.js";
import { localExecutor } from "../faults/local-executor.js";
import { isComplete, watch } from "../faults/watched-view.js";
import { data } from "../project.js";

const scan = data("vol_total.laz");
const foreign = data("ellipsoid.copc.laz");
/** 73 nodes of some eighty points each. */
const small = data("reports/k03_geokeys_only.copc.laz");

/** Milliseconds for which the server keeps each answer back: whatever does not wait for another comes within it. */
const DELAY = 60;

let server: BadServer;

/** Serves a file, each answer late, and keeps what was asked for. */
async function served(path: string) {
  const file = readFileSync(path);
  const asked: { at: number; bytes: number }[] = [];
  const began = performance.now();
  server = await BadServer.start(file, ({ first, last, answer }) => {
    asked.push({ at: performance.now() - began, bytes: last - first + 1 });
    setTimeout(answer, DELAY);
  });
  return { asked, trips: () => tripsOf(asked.map(({ at }) => at)) };
}

/** How many of the requests had to wait for the answer to another one. */
function tripsOf(times: readonly number[]): number {
  let trips = 0;
  let end = Number.NEGATIVE_INFINITY;
  for (const at of times) {
    if (at < end) continue;
    trips++;
    end = at + DELAY;
  }
  return trips;
}

afterEach(() => server.stop());

describe.skipIf(scan.missing)(
  `the first sight of a data set${scan.missing ? ` (skipped: ${scan.missing})` : ""}`,
  () => {
    let path: string;
    beforeAll(() => {
      path = converted(scan.path);
    }, 180_000);

    it("takes one trip to open what groma wrote, which brings its first points", async () => {
      const { asked } = await served(path);
      const cloud = await PointCloud.fromUrl(server.url, { executor: localExecutor() });
      const { count } = await cloud.loadNode("0-0-0-0");
      expect(count).toBeGreaterThan(1000);
      // Header, octree, checksums and the root's points.
      expect(asked.map(({ bytes }) => bytes)).toEqual([131_072]);
      cloud.destroy();
    });

    it("is open while the points behind the header are still on their way", async () => {
      const file = readFileSync(path);
      let goOn: () => void = () => undefined;
      server = await BadServer.start(file, ({ response, first, last }) => {
        response.writeHead(206, { "Content-Range": `bytes ${first}-${last}/${file.length}` });
        response.write(file.subarray(first, 20_000));
        goOn = () => response.end(file.subarray(20_000, last + 1));
      });
      const cloud = await PointCloud.fromUrl(server.url, { executor: localExecutor() });
      const root = cloud.loadNode("0-0-0-0");
      goOn();
      expect((await root).count).toBeGreaterThan(1000);
      expect(server.requests).toBe(1);
      cloud.destroy();
    });

    it("has the root decoded once while it is opened for a globe, and not for others", async () => {
      const decoded = async (onGlobe: boolean) => {
        await served(path);
        const executor = localExecutor();
        const run = vi.spyOn(executor, "run");
        const cloud = await PointCloud.open(server.url, { executor }, onGlobe);
        await vi.waitFor(() => expect(run.mock.calls.length).toBe(onGlobe ? 1 : 0));
        const { count } = await cloud.loadNode("0-0-0-0");
        expect(count).toBeGreaterThan(1000);
        expect(run.mock.calls.map(([{ node }]) => node)).toEqual(["0-0-0-0"]);
        await cloud.loadNode("0-0-0-0");
        expect(run).toHaveBeenCalledTimes(2);
        cloud.destroy();
        await server.stop();
      };
      await decoded(true);
      await decoded(false);
    });

    it("takes a second trip for points that do not come with the first one", async () => {
      const { asked, trips } = await served(path);
      const options = { executor: localExecutor(), headLength: 16_384 };
      const cloud = await PointCloud.fromUrl(server.url, options);
      // They were asked for without being waited for.
      expect(asked.length).toBeLessThanOrEqual(2);
      await cloud.loadNode("0-0-0-0");
      expect([asked.length, trips()]).toEqual([2, 2]);
      cloud.destroy();
    });
  },
);

describe.skipIf(foreign.missing)(
  `a COPC file of another writer${foreign.missing ? ` (skipped: ${foreign.missing})` : ""}`,
  () => {
    it("is asked once for nodes that lie next to each other", async () => {
      const { asked } = await served(small.path);
      const cloud = await PointCloud.fromUrl(server.url, {
        executor: localExecutor(),
        ...{ headLength: 1024, crs: "+proj=utm +zone=31 +datum=WGS84 +units=m" },
      });
      const view = watch(cloud);
      const { wanted } = await view.until(isComplete);
      expect(wanted).toBe(73);
      expect(asked.length).toBeLessThan(25);
      view.end();
      cloud.destroy();
    });

    it("takes three trips to its first points", async () => {
      const { trips } = await served(foreign.path);
      const cloud = await PointCloud.fromUrl(server.url, { executor: localExecutor() });
      await cloud.loadNode("0-0-0-0");
      expect(trips()).toBeLessThanOrEqual(3);
      cloud.destroy();
    });
  },
);

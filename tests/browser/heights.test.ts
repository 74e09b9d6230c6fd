import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import type { Cartesian3 } from "cesium";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data, projectRoot } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { ecef, pixelOf, settle } from "./globe.js";
import { launch, openPage, screenshot, type View, view } from "./harness.js";

const folder = join(projectRoot, "tests/artifacts/zones");
/** Middle of the scan that zones.py makes, degrees and metres above the ellipsoid. */
const MIDDLE = [6, 52, 50] as const;

/** Places of RD New + NAP by PROJ with the grids of the Netherlands: x, y, z and ECEF. */
const truth = data("truth/grid_rd_nap.json");
const grids = data("grids");
const projMissing = spawnSync("projinfo", ["--version"]).error && "PROJ's programs are not on PATH";
const geoidMissing = truth.missing ?? grids.missing ?? projMissing;

/** What the layer tells of its first node, its accuracy and its places. */
function told(page: Page) {
  return page.evaluate(async () => {
    const { cloud } = window.groma.layer;
    const { vertices, frame, bound } = await cloud.loadNode("0-0-0-0");
    const [x, y, z] = cloud.boundingBox.min;
    return {
      vertices: [...new Uint8Array(vertices)],
      frame: [...frame.origin, ...frame.rotation],
      ...{ bound, place: [...cloud.place(x, y, z)], accuracy: cloud.accuracy },
    };
  });
}

/** Looks north at the scan alone from its height, 700 m to the south, and waits until it is drawn. */
async function lookNorth(page: Page): Promise<void> {
  const from = ecef(MIDDLE[0], MIDDLE[1] - 0.0063, MIDDLE[2]);
  await page.evaluate((to) => {
    const orientation = { heading: 0, pitch: 0, roll: 0 };
    const { camera, scene } = window.groma.viewer;
    scene.globe.show = false;
    if (scene.skyAtmosphere) scene.skyAtmosphere.show = false;
    if (scene.skyBox) scene.skyBox.show = false;
    camera.setView({ destination: to as Cartesian3, orientation });
  }, from);
  await settle(page);
}

/** Mean row of the pixels that a picture has and one without the cloud has not, and how many they are. */
async function rowOfCloud(page: Page, name: string): Promise<{ row: number; pixels: number }> {
  const shown = await screenshot(page, name);
  await page.evaluate(() => {
    window.groma.layer.show = false;
  });
  await page.waitForTimeout(1500);
  const bare = await screenshot(page, `${name}-hidden`);
  await page.evaluate(() => {
    window.groma.layer.show = true;
  });
  await settle(page);
  let sum = 0;
  let pixels = 0;
  // To the right of the panel, whose text changes.
  for (let y = 0; y < shown.height; y++) {
    for (let x = 340; x < shown.width; x++) {
      const at = 4 * (y * shown.width + x);
      const same = [0, 1, 2].every(
        (channel) => Math.abs(shown.data[at + channel]! - bare.data[at + channel]!) < 24,
      );
      if (same) continue;
      sum += y;
      pixels++;
    }
  }
  return { row: sum / pixels, pixels };
}

describe.skipIf(pythonMissing)(
  `heights in the page${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let browser: Browser;
    let server: View;

    beforeAll(async () => {
      mkdirSync(folder, { recursive: true });
      const { zones } = runPython<{ zones: { file: string }[] }>("browser/zones.py", ["write", folder]);
      server = await view(converted(zones[0]!.file));
      browser = await launch();
    }, 240_000);

    afterAll(async () => {
      await browser?.close();
      await server?.stop();
    });

    it("lifts the picture by the height offset, and nothing that is told of the points", {
      timeout: 240_000,
    }, async () => {
      const { page, watch } = await openPage(browser, { width: 960, height: 600 });
      await page.goto(`${server.address}&fly=0&size=4&color=elevation`);
      await settle(page);
      await lookNorth(page);
      const before = { told: await told(page), seen: await rowOfCloud(page, "heights-in-place") };
      expect(before.seen.pixels).toBeGreaterThan(500);

      await page.fill("#lift", "40");
      await settle(page);
      expect(await page.textContent("#lift-note")).toContain("40 m above its place, for looks only");
      const after = { told: await told(page), seen: await rowOfCloud(page, "heights-lifted") };
      const [middle, higher] = [
        await pixelOf(page, ecef(...MIDDLE)),
        await pixelOf(page, ecef(MIDDLE[0], MIDDLE[1], MIDDLE[2] + 40)),
      ];
      const expected = middle.y - higher.y;
      expect(expected).toBeGreaterThan(20);
      expect(Math.abs(before.seen.row - after.seen.row - expected)).toBeLessThan(0.05 * expected);
      expect(after.told).toEqual(before.told);
      expect(watch.errors).toEqual([]);
      await page.context().close();
    });

    it.skipIf(geoidMissing)(
      `puts heights above NAP where PROJ with its grids has them${geoidMissing ? ` (skipped: ${geoidMissing})` : ""}`,
      { timeout: 240_000 },
      async () => {
        const { rows } = JSON.parse(readFileSync(truth.path, "utf8")) as { rows: number[][] };
        const [scan, copc] = ["rd-nap.las", "rd-nap.copc.laz"].map((name) => join(folder, name));
        const points = JSON.stringify(rows.map((row) => row.slice(0, 3)));
        runPython<number>("browser/heights.py", [scan!, "7415"], points);
        const groma = join(projectRoot, "converter/dist/main.js");
        const options = ["--overwrite", "--progress", "json", "--grids", grids.path];
        execFileSync(process.execPath, [groma, "convert", scan!, copc!, ...options], { stdio: "pipe" });
        const own = await view(copc!);
        try {
          const { page, watch } = await openPage(browser, { width: 640, height: 480 });
          await page.goto(`${own.address}&fly=0`);
          await settle(page);
          const { places, drawn, bound } = await page.evaluate(async (all) => {
            const { cloud } = window.groma.layer;
            const places = all.map(([x, y, z]) => [...cloud.place(x!, y!, z!)]);
            const { vertices, frame, count, bound } = await cloud.loadNode("0-0-0-0");
            const view = new DataView(vertices);
            const drawn: number[][] = [];
            for (let point = 0; point < count; point++) {
              const local = [0, 4, 8].map((at) => view.getFloat32(20 * point + at, true));
              drawn[view.getUint16(20 * point + 16, true)] = [0, 1, 2].map((axis) =>
                local.reduce(
                  (sum, metres, c) => sum + frame.rotation[3 * c + axis] * metres,
                  frame.origin[axis],
                ),
              );
            }
            return { places, drawn, bound };
          }, rows);
          const worst = (found: number[][]) =>
            Math.max(
              ...found.map((place, i) =>
                Math.hypot(...place.map((value, axis) => value - rows[i]![3 + axis]!)),
              ),
            );
          // The node is as wide as the country: what float32 costs there is part of its certificate.
          expect([places.length, drawn.length]).toEqual([rows.length, rows.length]);
          expect(worst(places)).toBeLessThanOrEqual(0.001);
          expect(worst(drawn)).toBeLessThanOrEqual(bound + 0.0001);
          const facts = await page.textContent("#facts");
          expect(facts).toContain("above NAP");
          expect(facts).toContain("geoid applied: nl_nsgi_nlgeo2018.tif");
          expect(facts).toContain("nl_nsgi_rdtrans2018.tif");
          expect(watch.errors).toEqual([]);
          await page.context().close();
        } finally {
          await own.stop();
        }
      },
    );

    it("says what heights are, and takes the reader's word where it can", { timeout: 240_000 }, async () => {
      const { page, watch } = await openPage(browser, { width: 960, height: 600 });
      await page.goto(`${server.address}&fly=0`);
      await settle(page);
      const height = () => page.evaluate(() => window.groma.layer.cloud.height.kind);
      const facts = () => page.textContent("#facts");
      expect(await height()).toBe("unknown");
      expect(await facts()).toMatch(/Heightunknown.*ellipsoidal/);
      expect(await page.inputValue("#height")).toBe("declared");

      await page.selectOption("#height", "ellipsoidal");
      await page.waitForFunction(() => window.groma.layer?.cloud.height.kind === "ellipsoidal");
      await settle(page);
      expect(await facts()).toContain("above the ellipsoid");
      expect(new URL(page.url()).searchParams.get("vertical")).toBe("ellipsoidal");

      // Heights above a geoid are for a conversion; the page says so and stays as it is.
      await page.selectOption("#height", "code");
      await page.fill("#height-code", "5709");
      await page.press("#height-code", "Enter");
      await page.waitForFunction(() => document.querySelector("#height-note")?.textContent !== "");
      expect(await page.textContent("#height-note")).toMatch(/groma convert .* --vertical EPSG:5709/);
      expect(await height()).toBe("ellipsoidal");

      await page.selectOption("#height", "declared");
      await page.waitForFunction(() => window.groma.layer?.cloud.height.kind === "unknown");
      expect(new URL(page.url()).searchParams.has("vertical")).toBe(false);
      expect(watch.errors).toEqual([]);
      await page.context().close();
    });
  },
);

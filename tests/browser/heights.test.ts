import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { decodeEgm96, ecefToGeodetic, egm96Undulation } from "@groma/georef";
import type { Cartesian3 } from "cesium";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { proj, projMissing } from "../proj.js";
import { data, projectRoot } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { ecef, hideCloud, pixelOf, settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";
import { twins } from "./zones.js";

const folder = join(projectRoot, "tests/artifacts/heights");
/** Middle of the scan that zones.py makes, degrees and metres above the ellipsoid. */
const MIDDLE = [6, 52, 50] as const;

const DEGREE = Math.PI / 180;
const egm96 = decodeEgm96(readFileSync(join(projectRoot, "layer/dist/cloud/egm96.bin")), "egm96.bin");

/** Places of RD New + NAP by PROJ with the grids of the Netherlands: x, y, z and ECEF. */
const truth = data("truth/grid_rd_nap.json");
const grids = data("grids");
const autzen = data("autzen.laz");
const autzenMissing = autzen.missing ?? data("grids/us_nga_egm96_15.tif").missing ?? projMissing;
const geoidMissing = truth.missing ?? grids.missing ?? projMissing;

/** What the layer tells of its first node, its accuracy and its places. */
function told(page: Page) {
  return page.evaluate(async () => {
    const { cloud } = window.groma.layer;
    const { positions, frame, bound } = await cloud.loadNode("0-0-0-0");
    const [x, y, z] = cloud.boundingBox.min;
    return {
      positions: [...positions],
      frame: [...frame.origin, ...frame.rotation],
      ...{ bound, place: [...cloud.place(x, y, z)], accuracy: cloud.accuracy },
    };
  });
}

/** Degrees and metres above the ellipsoid of the corners of the scan and of its first node, and what heights are worth. */
async function placed(page: Page) {
  const { points, accuracy } = await page.evaluate(async () => {
    const { cloud } = window.groma.layer;
    const { min, max } = cloud.boundingBox;
    const { frame } = await cloud.loadNode("0-0-0-0");
    return {
      points: [[...cloud.place(...min)], [...cloud.place(...max)], [...frame.origin]],
      accuracy: cloud.accuracy.parts.find(({ name }) => name === "height")?.metres,
    };
  });
  const places = points.map(([x, y, z]) => {
    const place = new Float64Array(3);
    ecefToGeodetic(x!, y!, z!, place);
    return [place[0]! / DEGREE, place[1]! / DEGREE, place[2]!];
  });
  return { places, accuracy };
}

/** Ellipsoidal height that PROJ makes of one above EGM96. */
function raisedByProj([longitude, latitude, height]: readonly number[]): number {
  const grid = `+grids=${data("grids/us_nga_egm96_15.tif").path}`;
  const args = ["-d", "6", "+proj=vgridshift", grid, "+multiplier=1"];
  const output = execFileSync(proj!.cct, args, {
    input: `${longitude} ${latitude} ${height} 0\n`,
    encoding: "utf8",
  });
  return Number(output.trim().split(/\s+/)[2]);
}

/** Names of what a page has fetched. */
const loaded = (page: Page) =>
  page.evaluate(() =>
    performance
      .getEntriesByType("resource")
      .map(({ name }) => name)
      .join(" "),
  );

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
  await hideCloud(page);
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
      const { zones } = await twins();
      server = await view(converted(zones[0]!.file));
      browser = await sharedBrowser();
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

      await page.click("#about summary");
      await page.fill("#lift", "40");
      await settle(page);
      expect(await page.textContent("#lift-note")).toContain("40 m above its position, display only");
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
        mkdirSync(folder, { recursive: true });
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
            const { positions, columns, frame, count, bound } = await cloud.loadNode("0-0-0-0");
            const drawn: number[][] = [];
            for (let point = 0; point < count; point++) {
              const local = [...positions.slice(3 * point, 3 * point + 3)];
              drawn[columns.get("intensity")!.data[point]!] = [0, 1, 2].map((axis) =>
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

    it("raises the picture by the geoid for the height system that the reader gives", {
      timeout: 240_000,
    }, async () => {
      const { page, watch } = await openPage(browser, { width: 960, height: 600 });
      await page.goto(`${server.address}&fly=0&size=4&color=elevation&vertical=ellipsoidal`);
      await settle(page);
      await lookNorth(page);
      const before = await rowOfCloud(page, "heights-ellipsoidal");
      expect(before.pixels).toBeGreaterThan(500);
      expect(await loaded(page)).not.toContain("egm96");

      await page.selectOption("#height", "code");
      await page.fill("#height-code", "5709");
      await page.press("#height-code", "Enter");
      await page.waitForFunction(() => window.groma.layer?.cloud.height.kind === "geoid");
      await settle(page);
      const after = await rowOfCloud(page, "heights-by-egm96");
      const undulation = egm96Undulation(egm96, MIDDLE[0] * DEGREE, MIDDLE[1] * DEGREE);
      const [middle, higher] = [
        await pixelOf(page, ecef(...MIDDLE)),
        await pixelOf(page, ecef(MIDDLE[0], MIDDLE[1], MIDDLE[2] + undulation)),
      ];
      const expected = middle.y - higher.y;
      expect(expected).toBeGreaterThan(20);
      expect(Math.abs(before.row - after.row - expected)).toBeLessThan(0.05 * expected);
      const facts = await page.textContent("#facts");
      expect(facts).toContain("above NAP");
      expect(facts).toContain("EGM96 instead of the national one");
      expect(new URL(page.url()).searchParams.get("vertical")).toBe("EPSG:5709");
      expect([watch.errors, watch.foreign]).toEqual([[], []]);
      await page.context().close();
    });

    it.skipIf(autzenMissing)(
      `offers NAVD88 for Autzen and lowers it by as much as PROJ does${autzenMissing ? ` (skipped: ${autzenMissing})` : ""}`,
      { timeout: 240_000 },
      async () => {
        const own = await view(converted(autzen.path));
        try {
          const { page, watch } = await openPage(browser, { width: 640, height: 480 });
          await page.goto(`${own.address}&fly=0`);
          await settle(page);
          await page.waitForFunction(() =>
            /metres|ellipsoidal/.test(document.querySelector("#height-note")?.textContent ?? ""),
          );
          expect(await page.textContent("#height-note")).toMatch(
            /NAVD88 height \(ft\) \(EPSG:8228\).* 22\.\d m lower/,
          );
          const before = await placed(page);
          await page.click("#height-note button");
          await page.waitForFunction(() => window.groma.layer?.cloud.height.kind === "geoid");
          await settle(page);
          const after = await placed(page);
          for (const [i, [longitude, latitude, height]] of before.places.entries()) {
            const moved = raisedByProj([longitude!, latitude!, height!]);
            const to = after.places[i]!;
            expect(Math.abs(to[2]! - moved)).toBeLessThan(0.006);
            expect(Math.hypot(to[0]! - longitude!, to[1]! - latitude!)).toBeLessThan(1e-9);
          }
          expect(after.accuracy).toBe(4);
          expect(await page.textContent("#facts")).toContain("EGM96 instead of the national one");

          // The address alone says the same.
          await page.goto(`${own.address}&fly=0&vertical=EPSG:8228`);
          await settle(page);
          expect((await placed(page)).places).toEqual(after.places);
          expect([watch.errors, watch.foreign]).toEqual([[], []]);
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

      // What is no height system is told by name, and the page stays as it is.
      await page.selectOption("#height", "code");
      await page.fill("#height-code", "2056");
      await page.press("#height-code", "Enter");
      await page.waitForFunction(() => document.querySelector("#message")?.textContent !== "");
      expect(await page.textContent("#message")).toContain("EPSG:2056 is not a vertical coordinate system");
      expect(await height()).toBe("ellipsoidal");
      expect(await page.inputValue("#height")).toBe("ellipsoidal");

      await page.selectOption("#height", "declared");
      await page.waitForFunction(() => window.groma.layer?.cloud.height.kind === "unknown");
      expect(new URL(page.url()).searchParams.has("vertical")).toBe(false);
      expect(watch.errors).toEqual([]);
      await page.context().close();
    });
  },
);

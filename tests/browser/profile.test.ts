import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { groma } from "../interop/groma.js";
import { data } from "../project.js";
import { settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";
import { lineIsChangedAndKept } from "./profile/keeping.js";
import { linkBringsTheProfileBack } from "./profile/link.js";
import { completed, plotIsMovedAndMeasured } from "./profile/plot.js";

const scan = data("vol_total.laz");

/** Pixels of three points of the cloud that lie apart, clear of the panels. */
async function pixelsOfPoints(page: Page): Promise<{ x: number; y: number }[]> {
  const found = await page.evaluate(async () => {
    const { layer, viewer } = window.groma;
    const pixels: { x: number; y: number }[] = [];
    const { count } = await layer.cloud.loadNode("0-0-0-0");
    for (let record = 0; record < count; record += Math.ceil(count / 100)) {
      const { source } = await layer.cloud.readPoint("0-0-0-0", { record });
      const [x, y, z] = layer.cloud.place(...source);
      const pixel = viewer.scene.cartesianToCanvasCoordinates({ x, y, z } as never);
      if (pixel && pixel.x > 360 && pixel.x < 960 && pixel.y > 60 && pixel.y < 345) {
        pixels.push({ x: pixel.x, y: pixel.y });
      }
    }
    return pixels;
  });
  found.sort((a, b) => a.x - b.x);
  return [0.1, 0.5, 0.9].map((share) => found[Math.floor(share * found.length)]!);
}

describe.skipIf(scan.missing)(
  `a profile in the page${scan.missing ? ` (skipped: ${scan.missing})` : ""}`,
  () => {
    let server: View;
    let browser: Browser;
    let folder: string;

    beforeAll(async () => {
      server = await view(converted(scan.path));
      browser = await sharedBrowser();
      folder = mkdtempSync(join(tmpdir(), "groma-page-profile-"));
    }, 240_000);

    afterAll(async () => {
      await browser?.close();
      await server?.stop();
      rmSync(folder, { recursive: true });
    });

    it("is drawn by clicks, shown whole, and exported to the bytes that the command line writes", {
      timeout: 480_000,
    }, async () => {
      const { page, watch } = await openPage(browser, { width: 1000, height: 700 }, "coarse");
      // Browsers with a file picker ask the user; the download is what a test can take.
      await page.addInitScript(() => {
        (window as { showSaveFilePicker?: unknown }).showSaveFilePicker = undefined;
      });
      // Fewer points are drawn than there are, so that software frames leave time for the rest.
      await page.goto(`${server.address}&fly=0&budget=60000`);
      await settle(page);
      await page.click("#above");
      await settle(page);
      await page.click("#profiles > summary");
      await page.click("#profile-draw");
      await page.fill("#profile-width", "4");
      for (const { x, y } of await pixelsOfPoints(page)) {
        const before = await page.evaluate(() => window.groma.profile.line.length);
        await page.mouse.click(x, y);
        await page.waitForFunction((count) => window.groma.profile.line.length > count, before, {
          timeout: 60_000,
        });
      }
      await page.click("#profile-draw");
      await completed(page);
      await page.waitForTimeout(500);
      const picture = await screenshot(page, "profile");
      const [line, shown] = await page.evaluate(
        () => [window.groma.profile.line, window.groma.profile.shown] as const,
      );
      expect(line).toHaveLength(3);
      expect(shown).toBeGreaterThan(1000);

      const downloading = page.waitForEvent("download");
      await page.click("#profile-export");
      const download = await downloading;
      expect(download.suggestedFilename()).toBe("vol_total-Line 1.las");
      const exported = join(folder, "page.las");
      await download.saveAs(exported);

      const file = join(folder, "line.geojson");
      const coordinates = line.map((vertex) => vertex.map((angle) => (angle * 180) / Math.PI));
      writeFileSync(file, JSON.stringify({ type: "LineString", coordinates }));
      const out = join(folder, "command.las");
      const run = groma(["profile", converted(scan.path), "--line", file, "--width", "4", "--out", out]);
      expect(run.code).toBe(0);
      const [here, there] = [readFileSync(exported), readFileSync(out)];
      expect(Number(here.readBigUInt64LE(247))).toBe(shown);
      expect(Buffer.compare(here, there)).toBe(0);

      // The picture has points of the scan's colours, more than axes and text would have.
      let coloured = 0;
      for (let y = 450; y < 620; y++) {
        for (let x = 420; x < 960; x++) {
          const at = 4 * (y * picture.width + x);
          const [red, green, blue] = picture.data.subarray(at, at + 3);
          if (Math.max(red!, green!, blue!) - Math.min(red!, green!, blue!) > 25) coloured++;
        }
      }
      expect(coloured).toBeGreaterThan(300);
      expect(watch.errors).toEqual([]);
      expect(watch.foreign).toEqual([]);

      await clippedPointsAreExported(page, folder);
      await plotIsMovedAndMeasured(page);
      await linkBringsTheProfileBack(page, browser);
      await lineIsChangedAndKept(page, folder, scan.path);
      await page.click("#profile-close");
      expect(await page.isVisible("#profile")).toBe(false);
      expect(watch.errors).toEqual([]);
      expect(watch.foreign).toEqual([]);
    });
  },
);

/** Exports what a polygon and a filter leave of the cloud, to the bytes of the command line; and gives an export up. */
async function clippedPointsAreExported(page: Page, folder: string): Promise<void> {
  const { ring, heights } = await page.evaluate(async () => {
    const { cloud, clips } = window.groma.layer;
    const { min, max } = cloud.boundingBox;
    const at = (u: number, v: number) => [min[0] + u * (max[0] - min[0]), min[1] + v * (max[1] - min[1])];
    const ring = [at(0.3, 0.35), at(0.7, 0.3), at(0.6, 0.7), at(0.5, 0.5)] as [number, number][];
    const ends = { bottom: undefined, top: undefined };
    clips.add({ kind: "polygon", mode: "inside", coordinates: "source", ring, ...ends });
    const heights = [0.2, 0.6].map((share) => min[2] + share * (max[2] - min[2])) as [number, number];
    window.groma.layer.filter = { ranges: { elevation: heights } };
    return { ring, heights };
  });
  await page.click("#share > summary");
  const downloading = page.waitForEvent("download");
  await page.selectOption("#export-format", "laz");
  await page.click("#export-points");
  const download = await downloading;
  expect(download.suggestedFilename()).toBe("vol_total-points.laz");
  const exported = join(folder, "points.laz");
  await download.saveAs(exported);

  const file = join(folder, "polygon.geojson");
  writeFileSync(file, JSON.stringify({ type: "Polygon", coordinates: [[...ring, ring[0]]] }));
  const out = join(folder, "clipped.laz");
  const polygon = ["--polygon", file, "--polygon-crs", "source", "--heights", heights.join(",")];
  expect(groma(["clip", converted(scan.path), ...polygon, "--out", out]).code).toBe(0);
  const [here, there] = [readFileSync(exported), readFileSync(out)];
  expect(Number(here.readBigUInt64LE(247))).toBeGreaterThan(1000);
  expect(Buffer.compare(here, there)).toBe(0);

  // A disk that takes its time: an export that is given up meanwhile leaves no file.
  await page.evaluate(() => {
    const told: string[] = [];
    let go = () => {};
    const createWritable = async () => ({
      write: () => new Promise<void>((resolve) => (go = resolve)),
      abort: async () => void told.push("abort"),
      close: async () => void told.push("close"),
    });
    Object.assign(window, { showSaveFilePicker: async () => ({ createWritable }), told, go: () => go() });
  });
  await page.click("#export-points");
  await expect.poll(() => page.textContent("#export-points")).toBe("Cancel");
  await page.click("#export-points");
  await page.evaluate(() => (window as unknown as { go: () => void }).go());
  await expect.poll(() => page.textContent("#export-status")).toBe("Nothing was written.");
  expect(await page.evaluate(() => (window as unknown as { told: string[] }).told)).toEqual(["abort"]);
  await page.evaluate(() => {
    (window as { showSaveFilePicker?: unknown }).showSaveFilePicker = undefined;
    window.groma.layer.clips.clear();
    window.groma.layer.filter = undefined;
  });
  await page.click("#share > summary");
}

import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { groma } from "../interop/groma.js";
import { data } from "../project.js";
import { settle } from "./globe.js";
import { launch, openPage, screenshot, type View, view } from "./harness.js";

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
      if (pixel && pixel.x > 360 && pixel.x < 960 && pixel.y > 60 && pixel.y < 380) {
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
      browser = await launch();
      folder = mkdtempSync(join(tmpdir(), "groma-page-profile-"));
    }, 240_000);

    afterAll(async () => {
      await browser?.close();
      await server?.stop();
      rmSync(folder, { recursive: true });
    });

    it("is drawn by clicks, shown whole, and exported to the bytes that the command line writes", {
      timeout: 240_000,
    }, async () => {
      const { page, watch } = await openPage(browser, { width: 1000, height: 700 });
      // Browsers with a file picker ask the user; the download is what a test can take.
      await page.addInitScript(() => {
        (window as { showSaveFilePicker?: unknown }).showSaveFilePicker = undefined;
      });
      await page.goto(`${server.address}&fly=0`);
      await settle(page);
      await page.click("#above");
      await settle(page);
      await page.click("#profile-draw");
      await screenshot(page, "profile-drawing");
      await page.fill("#profile-width", "4");
      for (const { x, y } of await pixelsOfPoints(page)) {
        const before = await page.evaluate(() => window.groma.profile.line.length);
        await page.mouse.click(x, y);
        await page.waitForFunction((count) => window.groma.profile.line.length > count, before, {
          timeout: 20_000,
        });
      }
      await page.keyboard.press("Escape");
      await page.waitForFunction(
        () => /complete$/.test(document.querySelector("#profile-status")!.textContent!),
        undefined,
        { timeout: 60_000 },
      );
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
      expect(download.suggestedFilename()).toBe("vol_total-profile.las");
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
      await page.click("#profile-close");
      expect(await page.isVisible("#profile")).toBe(false);
      expect(watch.errors).toEqual([]);
      expect(watch.foreign).toEqual([]);
    });
  },
);

import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { ecef, hideCloud, lookDown, pixelOf, settle } from "./globe.js";
import {
  colourDifference,
  meanColour,
  openPage,
  screenshot,
  sharedBrowser,
  type View,
  view,
} from "./harness.js";

interface Landmark {
  longitude: number;
  latitude: number;
  height: number;
  rgb: [number, number, number];
  contrast: number;
}

/** EPSG:2994 in PROJ's words: the CRS that the file's WKT spells out, feet of 0.3048 m in plane and height. */
const PROJ_STRING =
  "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +y_0=0 +ellps=GRS80 " +
  "+towgs84=0,0,0,0,0,0,0 +units=ft +no_defs";
const FOOT = 0.3048;

const scan = data("autzen.laz");
const missing = scan.missing ?? pythonMissing;

describe.skipIf(missing)(`Autzen on the globe${missing ? ` (skipped: ${missing})` : ""}`, () => {
  let server: View;
  let browser: Browser;

  beforeAll(async () => {
    server = await view(converted(scan.path));
    browser = await sharedBrowser();
  }, 240_000);

  afterAll(async () => {
    await browser?.close();
    await server?.stop();
  });

  it("opens without an error and without a request that leaves the machine", {
    timeout: 240_000,
  }, async () => {
    const { page, watch } = await openPage(browser, { width: 960, height: 600 }, "whole");
    await page.goto(`${server.address}&budget=1000000`);
    await settle(page);
    const shown = await screenshot(page, "autzen-oblique");
    // The panel tells what is drawn, and not what was when the last node arrived.
    const drawn = await page.evaluate(() => window.groma.layer.statistics.pointsDrawn);
    const told = `${drawn.toLocaleString("en")} points drawn`;
    expect(drawn).toBeGreaterThan(10_000);
    await page.waitForFunction((told) => document.querySelector("#count")!.textContent!.includes(told), told);
    expect(await page.textContent("#stage")).toBe("This view is complete.");
    await nothingIsDrawnTwice(page);
    await hideCloud(page);
    const hidden = await screenshot(page, "autzen-oblique-hidden");
    let changed = 0;
    for (let at = 0; at < shown.data.length; at += 4) {
      if (colourDifference(shown.data.subarray(at, at + 3), hidden.data.subarray(at, at + 3)) > 24) changed++;
    }
    // The cloud fills a good part of the first view; hidden, nothing of it is left.
    expect(changed / (shown.width * shown.height)).toBeGreaterThan(0.1);
    expect(watch.errors).toEqual([]);
    expect(watch.foreign).toEqual([]);
    await page.context().close();
  });

  it("shows the file's colours under known landmarks, and not with the layer hidden", {
    timeout: 280_000,
  }, async () => {
    const { page, watch } = await openPage(browser, { width: 480, height: 480 });
    await page.goto(`${server.address}&budget=1000000&size=5`);
    await settle(page);
    const bare = await page.evaluate(() => {
      window.groma.layer.show = false;
      return document.querySelector("canvas")?.getBoundingClientRect().height;
    });
    expect(bare).toBe(480);
    await lookDown(page, ecef(-123.0685, 44.056, 200));
    await hideCloud(page);
    const globe = meanColour(await screenshot(page, "autzen-bare-globe"), 240, 300, 30);
    const landmarks = runPython<Landmark[]>("browser/landmarks.py", [
      scan.path,
      PROJ_STRING,
      String(FOOT),
      "5",
      globe.join(),
    ]);
    expect(landmarks).toHaveLength(5);
    for (const [index, { longitude, latitude, height, rgb, contrast }] of landmarks.entries()) {
      // What the landmark stands out against is far from its colour: a cloud in the wrong place would show that.
      expect(contrast).toBeGreaterThan(80);
      await page.evaluate(() => {
        window.groma.layer.show = true;
      });
      await lookDown(page, ecef(longitude, latitude, height + 60));
      const { x, y } = await pixelOf(page, ecef(longitude, latitude, height));
      const shown = meanColour(await screenshot(page, `autzen-landmark-${index}`), x, y, 4);
      expect(colourDifference(shown, rgb), `landmark ${index}: ${shown} for ${rgb}`).toBeLessThan(20);
      await hideCloud(page);
      const hidden = meanColour(await screenshot(page, `autzen-landmark-${index}-hidden`), x, y, 4);
      expect(colourDifference(hidden, rgb), `landmark ${index} hidden`).toBeGreaterThan(30);
    }
    expect(watch.errors).toEqual([]);
    await page.context().close();
  });
});

/** Waits until the globe draws no frame while the page has some, and then changes an option, which it draws. */
async function nothingIsDrawnTwice(page: Page): Promise<void> {
  await page.evaluate(async () => {
    const { layer, viewer } = window.groma;
    let drawn = 0;
    viewer.scene.postRender.addEventListener(() => drawn++);
    const frames = async () => {
      drawn = 0;
      for (let frame = 0; frame < 10; frame++) await new Promise(requestAnimationFrame);
      return drawn;
    };
    while ((await frames()) > 0);
    // The mark on a picked point goes with its record.
    document.querySelector<HTMLButtonElement>("#unpick")!.click();
    while ((await frames()) === 0);
    layer.filter = { ranges: { intensity: [0, 1] } };
    while ((await frames()) === 0);
    layer.filter = undefined;
  });
  await settle(page);
}

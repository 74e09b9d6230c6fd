import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";

const folder = join(projectRoot, "tests/artifacts/annotations");
const saved = join(folder, "notes.geojson");
/** Frames of a busy machine come seldom. */
const SLOW = { timeout: 60_000 };

let browser: Browser;
let server: View;
let page: Page;

beforeAll(async () => {
  mkdirSync(folder, { recursive: true });
  const scan = join(folder, "box.las");
  writeFileSync(scan, lasOf(20_000));
  server = await view(scan, ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"]);
  browser = await sharedBrowser();
  ({ page } = await openPage(browser, { width: 900, height: 560 }));
}, 180_000);

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

const labels = () => page.locator("#globe .groma-label").allTextContents();
const camera = () =>
  page.evaluate(() => {
    const { x, y, z } = window.groma.viewer.camera.positionWC;
    return [x, y, z];
  });

it("an annotation is placed on a record and written, by keyboard alone", { timeout: 240_000 }, async () => {
  await page.goto(`${server.address}&fly=0&budget=60000`, { timeout: 120_000 });
  await settle(page);
  for (const fold of ["#measuring > summary", "#annotations > summary"]) {
    await page.focus(fold);
    await page.keyboard.press("Enter");
  }
  await page.focus("#annotate");
  await page.keyboard.press("Enter");
  expect(await page.getAttribute("#annotate", "aria-pressed")).toBe("true");
  await page.focus("#globe canvas");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  // It then asks for its title.
  await page.waitForFunction(() => document.activeElement?.matches("#annotation-list input"));
  await page.keyboard.type("Crack <b>here</b>");
  await page.keyboard.press("Tab");
  await page.keyboard.type("<img src=x onerror=alert(1)>\nSecond line");
  await page.click("#annotation-list button:text('Done')");
  expect(await page.isVisible("#annotation-list input")).toBe(false);
  expect(await labels()).toEqual(["Crack <b>here</b>"]);
  expect(await page.locator("#annotation-list .note span").allTextContents()).toEqual([
    "<img src=x onerror=alert(1)>",
    "Second line",
  ]);
  expect(await page.locator("#annotation-list :is(b, img)").count()).toBe(0);
  expect(await page.evaluate(() => window.groma.measure.measurements[0]!.vertices[0]!.record)).toBeDefined();
  await screenshot(page, "annotation");
});

it("is flown to with the camera that was there, and stands on the map too", {
  timeout: 240_000,
}, async () => {
  const before = await camera();
  await page.evaluate(() => window.groma.viewer.camera.moveBackward(5000));
  await page.click("#annotation-list .name");
  await expect
    .poll(async () => Math.hypot(...(await camera()).map((at, axis) => at - before[axis]!)), SLOW)
    .toBeLessThan(0.01);
  await page.selectOption("#views", "both");
  await expect
    .poll(() => page.locator("#map .groma-label").allTextContents(), SLOW)
    .toEqual(["Crack <b>here</b>"]);
  await page.selectOption("#views", "globe");
});

it("is saved with what is measured, deleted, and read again", { timeout: 240_000 }, async () => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#measure-save")]);
  await download.saveAs(saved);
  const [feature] = JSON.parse(readFileSync(saved, "utf8")).features;
  expect(feature.properties.text).toBe("<img src=x onerror=alert(1)>\nSecond line");
  await page.click("#annotation-list [aria-label^=Delete]");
  await expect.poll(labels, SLOW).toEqual([]);
  expect(await page.evaluate(() => document.activeElement?.id)).toBe("annotate");
  await page.setInputFiles("#measure-file", saved);
  await expect.poll(labels, SLOW).toEqual(["Crack <b>here</b>"]);
  expect(await page.textContent("#annotation-list .note")).toContain("Second line");
});

it("a file of a later version says what to do, and changes nothing", { timeout: 60_000 }, async () => {
  const later = join(folder, "later.geojson");
  writeFileSync(later, readFileSync(saved, "utf8").replace('"version": 1', '"version": 2'));
  await page.setInputFiles("#measure-file", later);
  await expect
    .poll(() => page.locator("#message .code").allTextContents(), SLOW)
    .toEqual(["MEASURE_VERSION"]);
  expect(await page.textContent("#message .fix")).toContain("later one");
  expect(await page.locator("#annotation-list li").count()).toBe(1);
});

it("of very many the last ones have labels, so that the page goes on", { timeout: 120_000 }, async () => {
  const kept = JSON.parse(readFileSync(saved, "utf8"));
  const [one] = kept.features;
  const many = Array.from({ length: 1_000 }, (_, at) => ({
    ...{ ...one, id: `many-${at}`, properties: { ...one.properties, name: `N ${at}` } },
  }));
  const file = join(folder, "many.geojson");
  writeFileSync(file, JSON.stringify({ ...kept, features: many }));
  await page.setInputFiles("#measure-file", file);
  await expect.poll(() => page.locator("#annotation-list li").count(), SLOW).toBe(1_001);
  const shown = () => page.locator("#globe .groma-label:not([hidden])").allTextContents();
  await expect.poll(async () => (await shown()).length, SLOW).toBe(200);
  expect([(await shown())[0], (await shown()).at(-1)]).toEqual(["N 800", "N 999"]);
});

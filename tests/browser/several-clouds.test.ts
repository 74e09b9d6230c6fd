import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { convert } from "../converted.js";
import { BadServer } from "../faults/bad-server.js";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { ecef, lookDown, settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";

const folder = join(projectRoot, "tests/artifacts/several");
const PLACE = ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"];

/** A name longer than a row of the list. */
const THIRD = "third-survey-of-the-river-north-of-the-bridge";

/** Frames of a busy machine come seldom. */
const SLOW = { timeout: 60_000 };

let browser: Browser;
let server: View;
/** Serves the second survey under another origin. */
let elsewhere: BadServer;
let page: Page;

/** A scan of 20,000 points some metres beside or below another one. */
function survey(name: string, steps: readonly [number, number, number], place = PLACE): string {
  const bytes = lasOf(20_000);
  const data = new DataView(bytes.buffer);
  for (const [axis, step] of steps.entries()) data.setFloat64(155 + 8 * axis, step, true);
  const [scan, copc] = ["las", "copc.laz"].map((ending) => join(folder, `${name}.${ending}`));
  writeFileSync(scan!, bytes);
  convert(scan!, copc!, place);
  return copc!;
}

beforeAll(async () => {
  mkdirSync(folder, { recursive: true });
  survey(THIRD, [0, 1500, 0], ["--crs", "+proj=utm +zone=32 +datum=WGS84 +units=us-ft"]);
  server = await view(survey("first", [500_000, 5_000_000, 0]));
  elsewhere = await BadServer.start(readFileSync(survey("second", [501_200, 5_000_000, 0])));
  browser = await sharedBrowser();
  ({ page } = await openPage(browser, { width: 800, height: 500 }));
}, 180_000);

afterAll(async () => {
  await browser?.close();
  await elsewhere?.stop();
  await server?.stop();
});

const names = () => page.locator("#cloud-list .name").allTextContents();
const chosen = () => page.locator("#cloud-list [aria-current=true]").textContent();
const drawn = () =>
  page.evaluate(() => window.groma.clouds.layers.map(({ statistics }) => statistics.pointsDrawn));

it("clouds come beside each other, from an address and from files", { timeout: 240_000 }, async () => {
  await page.goto(`${server.address}&fly=0&budget=60000`);
  await settle(page);
  expect(await names()).toEqual(["first.copc.laz"]);

  await page.click("#chooser summary");
  await page.fill("#address", elsewhere.url);
  await page.press("#address", "Enter");
  await page.waitForFunction(() => window.groma.layer?.cloud.name === "scan.copc.laz");
  await settle(page);
  expect(await names()).toEqual(["first.copc.laz", "scan.copc.laz"]);
  expect(await chosen()).toBe("scan.copc.laz");
  expect(await page.textContent("#title")).toBe("scan.copc.laz");

  await page.setInputFiles("#file", join(folder, `${THIRD}.copc.laz`));
  await page.waitForFunction((name) => window.groma.layer?.cloud.name === `${name}.copc.laz`, THIRD);
  expect(await chosen()).toBe(`${THIRD}.copc.laz`);
  // It has the attributes of the others, in its own units.
  const elevations = () => page.locator("#color option[value=elevation]").textContent();
  expect(await elevations()).toBe("elevation (US survey foot)");
  await page.click("#cloud-list li:first-child .name");
  expect(await elevations()).toBe("elevation (metre)");
  await page.click("#cloud-list li:last-child .name");
  // The same file again is the same cloud.
  await page.setInputFiles("#file", join(folder, `${THIRD}.copc.laz`));
  await page.waitForFunction(
    (name) => document.querySelector("#stage")!.textContent !== `Opening ${name}.copc.laz…`,
    THIRD,
  );
  expect(await names()).toHaveLength(3);
});

it("each row has room for its buttons, whatever the length of the names", async () => {
  const panel = (await page.locator("#panel").boundingBox())!;
  const buttons = page.locator("#cloud-list .icon-button");
  expect(await buttons.count()).toBe(6);
  for (const button of await buttons.all()) {
    const { x, width } = (await button.boundingBox())!;
    expect(x + width).toBeLessThan(panel.x + panel.width);
  }
  // What is cut of a name is told where it is pointed at.
  expect(await page.getAttribute("#cloud-list li:first-child .name", "title")).toBe("first.copc.laz");
});

it("of one that is out of the view the panel says so, and waits for nothing", async () => {
  await lookDown(page, ecef(-100, -40, 1000));
  await page.click("#cloud-list li:nth-child(2) .name");
  await expect.poll(() => page.textContent("#stage"), SLOW).toBe("No points in this view.");
});

it("each is shown, gone to and removed by itself; one is what the panel speaks of", {
  timeout: 240_000,
}, async () => {
  await page.click("#cloud-list li:nth-child(3) [aria-label^=Remove]");
  expect(await names()).toEqual(["first.copc.laz", "scan.copc.laz"]);
  // Whoever removed it goes on in the list.
  expect(await page.evaluate(() => document.activeElement?.textContent)).toBe("scan.copc.laz");
  await page.click("#cloud-list li:first-child .name");
  expect(await chosen()).toBe("first.copc.laz");
  await page.click("#looks > summary");
  await page.selectOption("#color", "intensity");
  expect(await page.evaluate(() => window.groma.clouds.layers.map(({ style }) => style.color))).toEqual([
    "intensity",
    "elevation",
  ]);
  await page.click("#cloud-list li:nth-child(2) [aria-label^='Go to']");
  await page.waitForFunction(() => (window.groma.clouds.layers[1]?.statistics.pointsDrawn ?? 0) > 1000);
  await screenshot(page, "several-clouds");
  await page.uncheck("#cloud-list li:nth-child(2) input");
  await page.waitForFunction(() => window.groma.clouds.layers[1]?.statistics.pointsDrawn === 0);
  await page.check("#cloud-list li:nth-child(2) input");
  await page.waitForFunction(() => (window.groma.clouds.layers[1]?.statistics.pointsDrawn ?? 0) > 1000);
});

it("a map beside the globe shows all of them", { timeout: 240_000 }, async () => {
  await page.selectOption("#views", "both");
  const shown = () =>
    page.evaluate(async () => {
      const { map } = (await window.groma.beside.view)!;
      return map
        .getLayers()
        .getArray()
        .filter((layer) => "statistics" in layer && layer.getVisible()).length;
    });
  await expect.poll(shown, SLOW).toBe(2);
  await page.uncheck("#cloud-list li:nth-child(2) input");
  await expect.poll(shown, SLOW).toBe(1);
  await page.check("#cloud-list li:nth-child(2) input");
  await page.selectOption("#views", "globe");
});

it("the page's address names them, and brings them back, the chosen one first", {
  timeout: 240_000,
}, async () => {
  await page.click("#cloud-list li:nth-child(2) .name");
  await page.uncheck("#cloud-list li:first-child input");
  await page.evaluate(() => {
    window.groma.layer.heightOffset = 5;
  });
  const named = new URL(page.url()).searchParams.getAll("cloud");
  expect(named).toEqual([elsewhere.url, new URL(server.address).searchParams.get("cloud")]);
  await page.locator("#copy-link").evaluate((button: HTMLButtonElement) => button.click());
  await page.locator("#link-note:has-text('link')").waitFor({ state: "attached" });
  await page.reload();
  await page.waitForFunction(() => window.groma?.clouds.layers.length === 2);
  expect(await names()).toEqual(["scan.copc.laz", "first.copc.laz"]);
  expect(await chosen()).toBe("scan.copc.laz");
  // The link keeps how each of them is drawn.
  const colours = () => page.evaluate(() => window.groma.clouds.layers.map(({ style }) => style.color));
  await expect.poll(colours, SLOW).toEqual(["elevation", "intensity"]);
  await expect.poll(async () => (await drawn())[0], SLOW).toBeGreaterThan(1000);
  const shown = () =>
    page.evaluate(() => window.groma.clouds.layers.map(({ show, heightOffset }) => [show, heightOffset]));
  expect(await shown()).toEqual([
    [true, 5],
    [false, 0],
  ]);
  expect(await page.isChecked("#cloud-list li:last-child input")).toBe(false);
  expect(await page.inputValue("#lift")).toBe("5");
});

it("one that does not come leaves the others, and can be given up", { timeout: 240_000 }, async () => {
  elsewhere.misbehave = () => undefined;
  await page.click("#chooser summary");
  await page.fill("#address", `${elsewhere.url}?again`);
  await page.press("#address", "Enter");
  await page.click("[aria-label='Give up scan.copc.laz']");
  await expect.poll(names, SLOW).toEqual(["scan.copc.laz", "first.copc.laz"]);
  elsewhere.misbehave = ({ response }) => response.writeHead(404).end();
  await page.fill("#address", `${elsewhere.url}?none`);
  await page.press("#address", "Enter");
  await expect
    .poll(() => page.locator("#message .code").allTextContents(), SLOW)
    .toEqual(["SOURCE_NOT_FOUND"]);
  expect(await names()).toEqual(["scan.copc.laz", "first.copc.laz"]);

  // Of several files that cannot be opened each is told.
  const bad = ["a", "b"].map((name) => ({
    ...{ name: `${name}.copc.laz`, mimeType: "", buffer: Buffer.from("no scan") },
  }));
  await page.setInputFiles("#file", bad);
  await expect.poll(() => page.locator("#message .code").count(), SLOW).toBe(2);
  expect(await page.textContent("#message")).toMatch(/a\.copc\.laz.*b\.copc\.laz/);

  for (let left = 2; left > 0; left--) await page.click("#cloud-list li:first-child [aria-label^=Remove]");
  expect(await page.isVisible("#of-cloud")).toBe(false);
  expect(await page.isVisible("#address")).toBe(true);
  expect(await page.textContent("#title")).toBe("Groma");
  expect(new URL(page.url()).searchParams.get("cloud")).toBeNull();
});

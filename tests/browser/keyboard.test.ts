import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";

let browser: Browser;
let server: View;
let folder: string;

beforeAll(async () => {
  const scans = join(projectRoot, "tests/artifacts/keyboard");
  mkdirSync(scans, { recursive: true });
  const scan = join(scans, "box.las");
  writeFileSync(scan, lasOf(20_000));
  server = await view(scan, ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"]);
  browser = await sharedBrowser();
  folder = mkdtempSync(join(tmpdir(), "groma-keyboard-"));
}, 180_000);

afterAll(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(folder, { recursive: true });
});

/** Goes to an element by the Tab key alone. */
async function tabTo(page: Page, selector: string): Promise<void> {
  for (let steps = 0; steps < 120; steps++) {
    if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector)) return;
    await page.keyboard.press("Tab");
  }
  throw new Error(`the Tab key does not lead to ${selector}`);
}

/** What a screen reader is told of the page, numbers left out. */
async function told(page: Page): Promise<string> {
  return `${(await page.locator("body").ariaSnapshot()).replace(/\d[\d.,]*/g, "#")}\n`;
}

const expected = (name: string) => join(import.meta.dirname, "expected", `${name}.aria.yml`);

it("from an empty page to an exported profile, by keyboard alone", { timeout: 300_000 }, async () => {
  const { page, watch } = await openPage(browser, { width: 1000, height: 700 }, "coarse");
  await page.addInitScript(() => {
    (window as { showSaveFilePicker?: unknown }).showSaveFilePicker = undefined;
  });
  await page.emulateMedia({ reducedMotion: "reduce" });
  const { origin, searchParams } = new URL(server.address);
  await page.goto(origin);
  await page.waitForSelector("#address");
  await expect(await told(page)).toMatchFileSnapshot(expected("empty"));
  await tabTo(page, "#address");
  await page.keyboard.type(new URL(searchParams.get("cloud")!, origin).href);
  await page.keyboard.press("Enter");
  await settle(page);
  await page.waitForFunction(
    () => document.querySelector("#stage")!.textContent === "This view is complete.",
  );
  await expect(await told(page)).toMatchFileSnapshot(expected("cloud"));
  await tabTo(page, "#above");
  await page.keyboard.press("Enter");
  await settle(page);
  await tabTo(page, "#profiles > summary");
  await page.keyboard.press("Enter");
  await tabTo(page, "#profile-draw");
  await page.keyboard.press("Enter");
  expect(await page.textContent("#drawing-words")).toMatch(/Escape gives it up/);
  await page.keyboard.press("Escape");
  expect(await page.textContent("#profile-draw")).toBe("Draw a profile");
  expect(await page.textContent("#drawing-words")).toBe("");
  await tabTo(page, "#profile-draw");
  await page.keyboard.press("Enter");
  // The crosshair starts in the middle of the view.
  const vertices = () => page.evaluate(() => window.groma.profile.line.length);
  for (const arrows of [0, 12]) {
    for (let step = 0; step < arrows; step++) await page.keyboard.press("ArrowRight");
    const before = await vertices();
    await page.keyboard.press("Enter");
    await page.waitForFunction((count) => window.groma.profile.line.length > count, before);
  }
  await screenshot(page, "keyboard-drawn");
  await tabTo(page, "#profile-draw");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => /complete$/.test(document.querySelector("#profile-status")!.textContent!));
  const downloading = page.waitForEvent("download");
  await tabTo(page, "#profile-export");
  await page.keyboard.press("Enter");
  const out = join(folder, "cut.las");
  await (await downloading).saveAs(out);
  const shown = await page.evaluate(() => window.groma.profile.shown);
  expect(shown).toBeGreaterThan(5);
  expect(Number(readFileSync(out).readBigUInt64LE(247))).toBe(shown);
  await page.waitForFunction(() =>
    /is written/.test(document.querySelector("#profile-status")!.textContent!),
  );
  await expect(await told(page)).toMatchFileSnapshot(expected("profile"));
  await screenshot(page, "keyboard");
  expect(watch.errors).toEqual([]);

  // A browser that has no room keeps the line on the page, and says so.
  await page.evaluate(() => {
    Storage.prototype.setItem = () => {
      throw new DOMException("no room", "QuotaExceededError");
    };
  });
  await tabTo(page, "#profile-reverse");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#message .code");
  expect(await page.textContent("#message .code")).toBe("PAGE_STORAGE");
  expect(await page.evaluate(() => window.groma.profile.line.length)).toBe(2);
  await page.context().close();
});

it("moves about the globe by keyboard alone, with a sheet of the keys", { timeout: 240_000 }, async () => {
  const { page, watch } = await openPage(browser, { width: 1000, height: 700 }, "coarse");
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(server.address);
  await settle(page);
  const camera = () =>
    page.evaluate(() => {
      const { heading, pitch, positionCartographic } = window.groma.viewer.camera;
      return { heading, pitch, height: positionCartographic.height };
    });
  await tabTo(page, "canvas[role=application]");
  const before = await camera();
  await page.keyboard.press("Shift+ArrowLeft");
  await page.waitForFunction((was) => window.groma.viewer.camera.heading !== was, before.heading);
  await page.keyboard.press("n");
  await page.waitForFunction(() => Math.abs(Math.sin(window.groma.viewer.camera.heading)) < 1e-4);
  await page.keyboard.press("+");
  await page.waitForFunction(
    (was) => window.groma.viewer.camera.positionCartographic.height < was,
    before.height,
  );
  await page.keyboard.press("u");
  await page.waitForFunction(() => window.groma.viewer.camera.pitch < -1.57);
  await page.keyboard.press("f");
  expect(await page.getAttribute("#walk", "aria-pressed")).toBe("true");
  await page.keyboard.press("f");
  await page.keyboard.press("?");
  await page.waitForSelector("#keys[open]");
  expect(await page.locator("#keys tr").count()).toBeGreaterThan(12);
  await screenshot(page, "keyboard-sheet");
  await page.keyboard.press("Escape");
  await page.waitForSelector("#keys:not([open])", { state: "attached" });
  // The globe has the keyboard again.
  expect(await page.evaluate(() => document.activeElement?.matches("canvas[role=application]"))).toBe(true);
  // A question mark that is written is none of the page's.
  await tabTo(page, "#about summary");
  await page.keyboard.press("Enter");
  await tabTo(page, "#lift");
  await page.keyboard.press("?");
  expect(await page.locator("#keys[open]").count()).toBe(0);
  expect(watch.errors).toEqual([]);
});

it("on a phone, what is drawn has the view for itself, with a way out that needs no keys", {
  timeout: 240_000,
}, async () => {
  const { page, watch } = await openPage(browser, { width: 390, height: 700 }, "coarse");
  await page.goto(`${server.address}&fly=0&budget=2000`);
  await settle(page);
  const free = () =>
    page.evaluate(() => document.elementFromPoint(195, 450)?.matches("canvas[role=application]"));
  const begin = async (fold: string, tool: string) => {
    await page.click("#fold");
    expect(await free()).toBe(false);
    await page.click(`${fold} > summary`);
    await page.click(tool);
    expect(await page.textContent("#drawing-words")).toMatch(/^Click/);
    expect(await free()).toBe(true);
  };
  await begin("#measuring", "#measure-tools button:has-text('Distance')");
  await screenshot(page, "phone-drawing");
  await page.click("#drawing-end");
  expect(await page.isVisible("#drawing-end")).toBe(false);
  expect(await page.textContent("#drawing-words")).toBe("");
  // The picture of a profile comes once there is one.
  await begin("#profiles", "#profile-draw");
  await page.click("#drawing-end");
  expect(await page.textContent("#profile-draw")).toBe("Draw a profile");
  // A place that was chosen for words opens the panel again, at the words.
  await page.click("#fold");
  await page.click("#annotations > summary");
  await page.click("#annotate");
  expect(await free()).toBe(true);
  await page.focus("canvas[role=application]");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.activeElement?.matches("#annotation-list input"));
  expect(await page.isVisible("#annotation-list input")).toBe(true);
  expect(watch.errors).toEqual([]);
  await page.context().close();
});

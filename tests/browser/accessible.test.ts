import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import type { AxeResults } from "axe-core";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
/** WCAG 2.2 AA with all that it stands on, and what axe calls good practice. */
const RULES = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];

let browser: Browser;
let server: View;
let page: Page;

beforeAll(async () => {
  const folder = join(projectRoot, "tests/artifacts/accessible");
  mkdirSync(folder, { recursive: true });
  const scan = join(folder, "box.las");
  writeFileSync(scan, lasOf(20_000));
  server = await view(scan, ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"]);
  browser = await sharedBrowser();
  ({ page } = await openPage(browser, { width: 1000, height: 700 }));
}, 180_000);

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

/** What axe finds on the page as it stands: rule, and where. */
async function violations(): Promise<string[]> {
  await page.evaluate(axe);
  const found = await page.evaluate(async (values) => {
    const { axe } = globalThis as unknown as {
      axe: { run(page: Document, options: object): Promise<AxeResults> };
    };
    return (await axe.run(document, { runOnly: { type: "tag", values } })).violations;
  }, RULES);
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`);
}

it("the page with globe and map has nothing that axe objects to", { timeout: 180_000 }, async () => {
  await page.goto(`${server.address}&map=1`);
  await page.waitForFunction(() => window.groma?.layer?.settled, undefined, { timeout: 120_000 });
  expect(await violations()).toEqual([]);

  await page.evaluate(() => {
    for (const part of Array.from(document.querySelectorAll("details"))) part.open = true;
  });
  expect(await violations()).toEqual([]);
  await page.click("#keys-open");
  expect(await violations()).toEqual([]);
  await page.keyboard.press("Escape");

  // As wide as a phone, which is 1280 px at 400 %.
  await page.setViewportSize({ width: 320, height: 640 });
  expect(await violations()).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(320);
  await screenshot(page, "accessible-320");
});

it("so has the page that says what went wrong", { timeout: 60_000 }, async () => {
  await page.goto(new URL("?cloud=none.copc.laz", server.address).href);
  await page.waitForSelector("#message:not(:empty)", { timeout: 50_000 });
  expect(await violations()).toEqual([]);
});

it("something that is not accessible is seen (negative control)", { timeout: 60_000 }, async () => {
  await page.evaluate(() => document.querySelector("main")!.append(document.createElement("input")));
  expect((await violations())[0]).toMatch(/^label: /);
});

import type { Browser, Page } from "playwright-core";
import { expect } from "vitest";
import { openPage } from "../harness.js";
import { completed } from "./plot.js";

/** Copies a link to the page, and opens it where nothing is kept. */
export async function linkBringsTheProfileBack(page: Page, browser: Browser): Promise<void> {
  await page.fill("#profile-from", "250.5");
  await page.press("#profile-from", "Enter");
  await completed(page);
  await page.locator("#copy-link").evaluate((button: HTMLButtonElement) => button.click());
  const { page: other } = await openPage(browser, { width: 1000, height: 700 }, "coarse");
  await other.goto(page.url());
  await completed(other);
  for (const field of ["#profile-name", "#profile-width", "#profile-from"])
    expect(await other.inputValue(field)).toBe(await page.inputValue(field));
  const drawn = () => [window.groma.profile.line, window.groma.profile.shown];
  expect(await other.evaluate(drawn)).toEqual(await page.evaluate(drawn));
  await other.context().close();
  // Or the line is brought back once more, however it is changed, when this page is loaded anew.
  await page.evaluate(() => history.replaceState(null, "", location.pathname + location.search));
  await page.fill("#profile-from", "0");
  await page.press("#profile-from", "Enter");
  await completed(page);
}

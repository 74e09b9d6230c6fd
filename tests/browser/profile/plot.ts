import type { Page } from "playwright-core";
import { expect } from "vitest";
import { screenshot } from "../harness.js";

/** Waits until all points are in the picture. */
export const completed = (page: Page) =>
  page.waitForFunction(
    () => /complete$/.test(document.querySelector("#profile-status")!.textContent!),
    undefined,
    { timeout: 60_000 },
  );

/** Text of the line below the picture. */
export const readout = (page: Page) => page.textContent("#profile-readout");

const heightOfPlot = (page: Page) => page.evaluate(() => window.groma.profile.plot!.view.height);

/** Pixel of the page of the plotted point nearest to the middle of the plot. */
export async function pixelOfPlottedPoint(page: Page): Promise<{ x: number; y: number; chainage: number }> {
  return page.evaluate(() => {
    const { plot } = window.groma.profile;
    const { view, parts } = plot!;
    const box = document.querySelector("#profile-plot")!.getBoundingClientRect();
    let found = { x: 0, y: 0, chainage: 0, away: Number.POSITIVE_INFINITY };
    for (const { chainage, height } of parts) {
      for (let index = 0; index < chainage.length; index++) {
        const [x, y] = view.pixelOf(chainage[index]!, height[index]!);
        const away = Math.hypot(x - view.width / 2, y - view.height / 2);
        if (away < found.away) found = { x, y, chainage: chainage[index]!, away };
      }
    }
    return { x: box.left + found.x, y: box.top + found.y, chainage: found.chainage };
  });
}

/** Pans, zooms, points at, picks and measures in the picture, by mouse and by keys; reads it as a table. */
export async function plotIsMovedAndMeasured(page: Page): Promise<void> {
  const seen = () =>
    page.evaluate(() => ({
      ...window.groma.profile.plot!.view.shown,
      exaggeration: window.groma.profile.plot!.view.exaggeration,
    }));
  // What is wanted less often is folded, and leaves the picture its room.
  expect(await page.isVisible("#profile-ground")).toBe(false);
  const tall = await heightOfPlot(page);
  await page.click("#profile-more > summary");
  await expect.poll(() => heightOfPlot(page)).toBeLessThan(tall);
  await page.click("#profile-fit");
  const whole = await seen();
  const target = await pixelOfPlottedPoint(page);
  await page.mouse.move(target.x, target.y);
  await expect
    .poll(() => readout(page))
    .toMatch(new RegExp(`^chainage ${target.chainage.toFixed(2)} m, height `));

  await page.mouse.click(target.x, target.y);
  await page.waitForSelector("#picked:not([hidden])");
  const shownRecord = await page.textContent("#picked-facts");
  expect(shownRecord).toMatch(/node, record/);

  await page.mouse.wheel(0, -300);
  await expect
    .poll(async () => ((await seen()).to - (await seen()).from) / (whole.to - whole.from))
    .toBeCloseTo(0.5, 2);
  await page.mouse.down();
  await page.mouse.move(target.x + 60, target.y, { steps: 3 });
  await page.mouse.up();
  const panned = await seen();
  await page.click("#profile-true");
  expect((await seen()).exaggeration).toBeCloseTo(1, 6);
  await page.fill("#profile-stretch", "5");
  await page.press("#profile-stretch", "Enter");
  expect((await seen()).exaggeration).toBeCloseTo(5, 6);
  expect((await seen()).from).toBeCloseTo(panned.from, 6);
  await page.click("#profile-fit");
  expect(await seen()).toEqual(whole);

  await page.selectOption("#profile-ground", "p25");
  await page.check("#profile-table-shown");
  await page.waitForSelector("#profile-table td");
  expect(await page.textContent("#profile-table caption")).toBe(
    "Ground, percentile 25 of each station, metres",
  );
  expect(await page.locator("#profile-axes .ground").count()).toBeGreaterThan(0);
  await page.uncheck("#profile-table-shown");
  // The scan has one class alone: from its greatest to its least height, which is below.
  await page.fill("#profile-ground-class", "0");
  await page.fill("#profile-clearance", "0");
  await page.press("#profile-clearance", "Enter");
  const clearance = () => page.textContent("#profile-clearance-words");
  await expect
    .poll(clearance)
    .toMatch(/^Least clearance of class 0 over class 0: -\d+\.\d{3} m at chainage /);
  await page.fill("#profile-clearance", "5");
  await page.press("#profile-clearance", "Enter");
  await expect.poll(clearance).toBe("No station has points of class 5 over class 0");
  await page.fill("#profile-clearance", "");
  const groundWords = () => page.textContent("#profile-ground-words");
  expect(await groundWords()).toBe("");
  await page.fill("#profile-ground-class", "7");
  await page.press("#profile-ground-class", "Enter");
  await expect.poll(groundWords).toBe("No point along the line is of class 7: there is no ground.");
  await page.fill("#profile-ground-class", "");
  await page.press("#profile-ground-class", "Enter");
  await expect.poll(groundWords).toBe("");

  await page.click("#profile-measure");
  await page.focus("#profile-plot");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  for (let step = 0; step < 20; step++) await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Enter");
  expect(await readout(page)).toMatch(
    /^along [\d.-]+ m, up [\d.-]+ m, slant [\d.]+ m, .*°; a level sight rises 0\.00\d m .*; the ground (lies|stands) .*; ground above/,
  );
  await expect
    .poll(() => page.locator("#profile-axes .sight").getAttribute("points"))
    .toMatch(/^(\S+ ){48}\S+$/);
  await screenshot(page, "profile-measured");
  await page.click("#profile-measure");
  await page.selectOption("#profile-colour", "offset");
}

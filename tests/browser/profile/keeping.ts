import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { expect } from "vitest";
import { converted } from "../../converted.js";
import { settle } from "../globe.js";
import { screenshot } from "../harness.js";
import { completed, pixelOfPlottedPoint, readout } from "./plot.js";

/** A COPC file with all heights a metre greater: its offset (LAS 1.4 R15, table 3), bounds, and the middle of its octree. */
function raised(file: Buffer): Buffer {
  for (const at of [171, 211, 219, 375 + 54 + 16]) file.writeDoubleLE(file.readDoubleLE(at) + 1, at);
  return file;
}

/** Names, reverses and widens the line, moves a vertex by keys, and finds all that again after the page is loaded anew. */
export async function lineIsChangedAndKept(page: Page, folder: string, scan: string): Promise<void> {
  const complete = () => completed(page);
  const line = () => page.evaluate(() => window.groma.profile.line);
  const before = await line();
  await page.click("#profile-reverse");
  expect(await line()).toEqual([...before].reverse());
  await complete();
  await page.fill("#profile-name", "dike <b>");
  await page.press("#profile-name", "Enter");
  await complete();
  const shown = await page.evaluate(() => window.groma.profile.shown);
  await page.focus(".width-handle");
  await page.keyboard.press("ArrowUp");
  await expect.poll(() => page.inputValue("#profile-width")).toBe("4.4");
  await complete();
  expect(await page.evaluate(() => window.groma.profile.shown)).toBeGreaterThan(shown);

  await page.fill("#profile-from", "250.5");
  await page.press("#profile-from", "Enter");
  await complete();
  const from = () => page.evaluate(() => window.groma.profile.plot!.view.shown.from);
  expect(await from()).toBeGreaterThan(240);

  // By what tells the scan from others, which may have its name.
  const [keys, identity] = await page.evaluate(
    () => [Object.keys(localStorage), window.groma.layer.cloud.identity] as const,
  );
  expect(keys.filter((key) => key.startsWith("groma-profiles:"))).toEqual([`groma-profiles:${identity}`]);
  await page.reload();
  await page.waitForSelector("#profile-list:not([hidden])", { state: "attached", timeout: 60_000 });
  await page.click("#profiles > summary");
  await settle(page);
  expect(await page.locator("#profile-list option").allTextContents()).toEqual(["profiles…", "dike <b>"]);
  await page.selectOption("#profile-list", { label: "dike <b>" });
  await complete();
  // A line has its own width and chainage at the start, on the next visit too.
  expect(await page.inputValue("#profile-width")).toBe("4.4");
  expect(await page.inputValue("#profile-from")).toBe("250.5");
  expect(await from()).toBeGreaterThan(240);
  const kept = await line();
  for (const [index, vertex] of [...before].reverse().entries()) {
    expect(kept[index]![0]).toBeCloseTo(vertex[0]!, 12);
    expect(kept[index]![1]).toBeCloseTo(vertex[1]!, 12);
  }
  // Another page of the scan keeps a line, and then takes it out: what is kept here leaves it alone.
  const options = () => page.locator("#profile-list option").allTextContents();
  const keepElsewhere = (names: readonly string[]) =>
    page.evaluate((wanted) => {
      const key = Object.keys(localStorage).find((one) => one.startsWith("groma-profiles:"))!;
      const document = JSON.parse(localStorage.getItem(key)!);
      const [one] = document.features;
      const more = wanted.map((name) => ({ ...one, id: name, properties: { ...one.properties, name } }));
      localStorage.setItem(key, JSON.stringify({ ...document, features: [one, ...more] }));
      return key;
    }, names);
  await keepElsewhere(["of another page"]);
  await page.fill("#profile-width", "4.5");
  await page.press("#profile-width", "Enter");
  await expect.poll(options).toEqual(["profiles…", "dike <b>", "of another page"]);
  const key = await keepElsewhere([]);
  await page.evaluate((of) => dispatchEvent(new StorageEvent("storage", { key: of })), key);
  await expect.poll(options).toEqual(["profiles…", "dike <b>"]);
  await complete();
  // A width that is none changes nothing but the field.
  await page.fill("#profile-width", "");
  await page.press("#profile-width", "Enter");
  expect(await page.locator("#profile-width:invalid").count()).toBe(1);
  expect(await page.textContent("#profile-status")).toMatch(/complete$/);
  await page.fill("#profile-width", "4.4");
  await page.press("#profile-width", "Enter");
  await complete();
  await page.click("#profile-remove");
  await expect.poll(line).toEqual([]);
  // Of a line that is gone no picture stays, nor what could be exported of it.
  expect(await page.evaluate(() => window.groma.profile.shown)).toBe(0);
  expect(await page.textContent("#profile-status")).toBe("");
  expect(await page.isDisabled("#profile-export")).toBe(true);
  expect(await page.isVisible("#profile-list")).toBe(false);
  expect(await page.inputValue("#profile-from")).toBe("0");

  // An alignment of the scan's own coordinates: its stations, as the command line has them.
  const corners = await page.evaluate(() => {
    const { min, max } = window.groma.layer.cloud.boundingBox;
    const at = (u: number, v: number) => [min[0] + u * (max[0] - min[0]), min[1] + v * (max[1] - min[1])];
    return [at(0.3, 0.4), at(0.6, 0.5)].map(([x, y]) => `${y} ${x}`);
  });
  const geometry = `<Line><Start>${corners[0]}</Start><End>${corners[1]}</End></Line>`;
  const alignment = `<Alignment name="axis" length="0" staStart="1200"><CoordGeom>${geometry}</CoordGeom><StaEquation staInternal="1250" staAhead="5000"/></Alignment>`;
  const buffer = Buffer.from(
    `<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2"><Alignments>${alignment}</Alignments></LandXML>`,
  );
  await page.setInputFiles("#profile-file", { name: "axis.xml", mimeType: "text/xml", buffer });
  await expect.poll(async () => (await line()).length).toBe(2);
  await complete();
  expect(await page.inputValue("#profile-name")).toBe("axis");
  expect(await from()).toBeGreaterThan(1100);
  // Its station equation is told of points, and written.
  const { x, y, chainage } = await pixelOfPlottedPoint(page);
  await page.mouse.move(x, y);
  const station = `5\\+0${(chainage - 1250).toFixed(2)}`;
  await expect.poll(() => readout(page)).toMatch(new RegExp(`, station ${station}$`));
  await page.selectOption("#profile-format", "xml");
  const downloading = page.waitForEvent("download");
  await page.click("#profile-export");
  const written = readFileSync(await (await downloading).path(), "utf8");
  expect(written).toContain('<StaEquation staInternal="1250.00000" staAhead="5000.00000"');
  await page.click("#profile-more > summary");
  await page.selectOption("#profile-cut", "inside");
  expect(await page.evaluate(() => window.groma.layer.clips.size)).toBe(1);
  await page.selectOption("#profile-cut", "");
  expect(await page.evaluate(() => window.groma.layer.clips.size)).toBe(0);

  // Another survey of the place, all of it a metre higher.
  const other = join(folder, "raised.copc.laz");
  writeFileSync(other, raised(readFileSync(converted(scan))));
  await page.setInputFiles("#profile-other", other);
  const compared = () => page.textContent("#profile-compared");
  await expect.poll(compared, { timeout: 120_000 }).toMatch(/^raised.copc.laz: .* 1\.000 m in the mean/);
  expect(await compared()).toContain(" 0.00 m² below it");
  await screenshot(page, "profile-compared");
  await page.click("#profile-alone");
  await expect.poll(compared).toBe("");
  await page.click("#profile-undo");
  await expect.poll(line).toEqual([]);
  await page.click("#profile-redo");
  await expect.poll(async () => page.locator("#profile-list option").count()).toBe(2);
}

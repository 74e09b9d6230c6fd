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
      const { page, watch } = await openPage(browser, { width: 1000, height: 700 });
      page.setDefaultTimeout(120_000);
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
      expect(watch.errors).toEqual([]);
      expect(watch.foreign).toEqual([]);

      await clippedPointsAreExported(page, folder);
      await plotIsMovedAndMeasured(page);
      await lineIsChangedAndKept(page, folder);
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

/** A COPC file with all heights a metre greater: its offset (LAS 1.4 R15, table 3), bounds, and the middle of its octree. */
function raised(file: Buffer): Buffer {
  for (const at of [171, 211, 219, 375 + 54 + 16]) file.writeDoubleLE(file.readDoubleLE(at) + 1, at);
  return file;
}

/** Text of the line below the picture. */
const readout = (page: Page) => page.textContent("#profile-readout");

/** Pixel of the page of the plotted point nearest to the middle of the plot. */
async function pixelOfPlottedPoint(page: Page): Promise<{ x: number; y: number; chainage: number }> {
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
async function plotIsMovedAndMeasured(page: Page): Promise<void> {
  const seen = () =>
    page.evaluate(() => ({
      ...window.groma.profile.plot!.view.shown,
      exaggeration: window.groma.profile.plot!.view.exaggeration,
    }));
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
  await page.fill("#profile-ground-class", "");
  await page.press("#profile-ground-class", "Enter");

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
    .poll(() => page.locator("#profile-axes .sight").getAttribute("points"), { timeout: 60_000 })
    .toMatch(/^(\S+ ){48}\S+$/);
  await screenshot(page, "profile-measured");
  await page.click("#profile-measure");
  await page.selectOption("#profile-colour", "offset");
}

/** Names, reverses and widens the line, moves a vertex by keys, and finds all that again after the page is loaded anew. */
async function lineIsChangedAndKept(page: Page, folder: string): Promise<void> {
  const complete = () =>
    page.waitForFunction(
      () => /complete$/.test(document.querySelector("#profile-status")!.textContent!),
      undefined,
      {
        timeout: 60_000,
      },
    );
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
  await page.selectOption("#profile-cut", "inside");
  expect(await page.evaluate(() => window.groma.layer.clips.size)).toBe(1);
  await page.selectOption("#profile-cut", "");
  expect(await page.evaluate(() => window.groma.layer.clips.size)).toBe(0);

  // Another survey of the place, all of it a metre higher.
  const other = join(folder, "raised.copc.laz");
  writeFileSync(other, raised(readFileSync(converted(scan.path))));
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

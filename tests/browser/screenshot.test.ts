import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { geodesicFrom } from "@groma/georef";
import type { Browser, Page } from "playwright-core";
import { PNG } from "pngjs";
import { afterAll, beforeAll, expect, it } from "vitest";
import { convert } from "../converted.js";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { ecef, lookDown, settle } from "./globe.js";
import { openPage, sharedBrowser, type View, view } from "./harness.js";

const folder = join(projectRoot, "tests/artifacts/screenshot");
const PLACE = ["--crs", "EPSG:32632", "--vertical", "ellipsoidal"];
const DEGREE = Math.PI / 180;
const SIZE = { width: 640, height: 400 };
/** CSS pixels of the plate's corner from that of the view, and what it has inside; as in demo/src/screenshot/sheet.ts. */
const MARGIN = 12;
const PLATE = 56;

let browser: Browser;
let server: View;
let page: Page;
let errors: readonly string[];

/** A level square of points of 1 km, 425 m above the ellipsoid, as COPC. */
function box(name: string): string {
  const bytes = lasOf(20_000);
  const data = new DataView(bytes.buffer);
  for (const [axis, at] of [500_000, 5_000_000, 425].entries()) data.setFloat64(155 + 8 * axis, at, true);
  // A point of 50,000 steps lies 5 mm higher.
  data.setFloat64(147, 1e-7, true);
  const [scan, copc] = ["las", "copc.laz"].map((ending) => join(folder, `${name}.${ending}`));
  writeFileSync(scan!, bytes);
  convert(scan!, copc!, PLACE);
  return copc!;
}

beforeAll(async () => {
  mkdirSync(folder, { recursive: true });
  server = await view(box("box"));
  browser = await sharedBrowser();
  const opened = await openPage(browser, SIZE);
  ({ page } = opened);
  ({ errors } = opened.watch);
  // What the pictures say, as it is drawn on them.
  await page.addInitScript(() => {
    (window as { showSaveFilePicker?: unknown }).showSaveFilePicker = undefined;
    const said: string[] = [];
    Object.assign(window, { said });
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...where) {
      if (!said.includes(text)) said.push(text);
      fillText.call(this, text, ...where);
    };
  });
  await page.goto(`${server.address}&fly=0&budget=60000`);
  await settle(page);
}, 240_000);

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

/** Has the page save its picture. */
async function shoot(name: string): Promise<PNG> {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.locator("#screenshot").evaluate((button: HTMLButtonElement) => button.click()),
  ]);
  const path = join(folder, `${name}.png`);
  await download.saveAs(path);
  expect(download.suggestedFilename()).toMatch(/\.png$/);
  return PNG.sync.read(readFileSync(path));
}

/** The words on the pictures since they were asked for last, without what keeps their direction. */
const words = () =>
  page.evaluate(() => {
    const { said } = window as unknown as { said: string[] };
    return said.splice(0).map((text) => text.replaceAll(/[\u2066-\u2069]/g, ""));
  });

type Test = (r: number, g: number, b: number) => boolean;
const ink: Test = (r, g, b) => r < 40 && g < 45 && b < 55;
const red: Test = (r, g, b) => r > 140 && g < 90 && b < 90;

/** Places of the pixels of a colour on the plate of a view. @param left of the view, CSS pixels */
function onPlate({ data, width }: PNG, left: number, test: Test, ratio = 1): [number, number][] {
  const found: [number, number][] = [];
  const bottom = (SIZE.height - MARGIN) * ratio;
  for (let y = bottom - PLATE * ratio; y < bottom; y++) {
    for (let x = (left + MARGIN) * ratio; x < (left + MARGIN + 340) * ratio; x++) {
      const at = 4 * (y * width + x);
      if (test(data[at]!, data[at + 1]!, data[at + 2]!)) found.push([x, y]);
    }
  }
  return found;
}

/** Pixels of the scale bar: the longest row of ink on the plate. */
function barOf(picture: PNG, left = 0, ratio = 1): number {
  const rows = new Map<number, number[]>();
  for (const [x, y] of onPlate(picture, left, ink, ratio)) rows.set(y, [...(rows.get(y) ?? []), x]);
  let longest = 0;
  for (const row of rows.values()) {
    let run = 0;
    for (const [i, x] of row.entries()) {
      run = row[i - 1] === x - 1 ? run + 1 : 1;
      longest = Math.max(longest, run);
    }
  }
  return longest;
}

/** Degrees clockwise from the picture's upper edge in which the north arrow points: from its middle to its tip. */
function arrowOf(picture: PNG, left = 0): number {
  const pixels = onPlate(picture, left, red);
  const mean = [0, 1].map((axis) => pixels.reduce((sum, at) => sum + at[axis]!, 0) / pixels.length);
  const far = pixels.map(([x, y]) => [x - mean[0]!, y - mean[1]!] as const);
  const [dx, dy] = far.sort((a, b) => Math.hypot(...b) - Math.hypot(...a))[0]!;
  return Math.atan2(dx, -dy) / DEGREE;
}

/** Metres of a label of a bar. */
const metresOf = (said: readonly string[]) => {
  const [, count, unit] = said.flatMap((text) => /^([\d,.]+)\s(k?m)$/.exec(text) ?? []);
  return Number(count!.replaceAll(",", "")) * (unit === "km" ? 1000 : 1);
};

/** Pixels between the ends of a geodesic of 100 m through a place, across the view, by Cesium. */
async function seenOnGlobe(longitude: number, latitude: number, heading: number): Promise<number> {
  const ends = [90, -90].map((side) => {
    const end = geodesicFrom(longitude * DEGREE, latitude * DEGREE, (heading + side) * DEGREE, 50);
    return ecef(end.longitude / DEGREE, end.latitude / DEGREE, 425);
  });
  return page.evaluate((places) => {
    const [a, b] = places.map(
      (place) => window.groma.viewer.scene.cartesianToCanvasCoordinates(place as never)!,
    );
    return Math.hypot(a!.x - b!.x, a!.y - b!.y);
  }, ends);
}

const LONGITUDE = 9.0064;
const LATITUDE = 45.1579;

it("has a scale bar that is right, north where it is, and the sources below", {
  timeout: 240_000,
}, async () => {
  await lookDown(page, ecef(LONGITUDE, LATITUDE, 1425));
  await words();
  const picture = await shoot("down");
  expect(picture.width).toBe(SIZE.width);
  expect(picture.height).toBeGreaterThan(SIZE.height);
  const said = await words();
  expect(said).toContain("N");
  const today = new Date().toLocaleDateString("en", { dateStyle: "long" });
  const sources = said.filter((text) => text.includes(" · "));
  expect(sources).toEqual([
    "box.copc.laz · WGS 84 / UTM zone 32N + ellipsoidal height (EPSG:32632) · Height: above the ellipsoid",
    `Natural Earth · ${today} · Groma`,
  ]);
  const seen = await seenOnGlobe(LONGITUDE, LATITUDE, 0);
  expect(Math.abs(barOf(picture) / metresOf(said) / (seen / 100) - 1)).toBeLessThan(0.01);
  expect(arrowOf(picture)).toBeCloseTo(0, -1);

  // The bar of another distance is not that of this one (negative control).
  await lookDown(page, ecef(LONGITUDE, LATITUDE, 1445));
  const farther = await seenOnGlobe(LONGITUDE, LATITUDE, 0);
  expect(Math.abs(barOf(picture) / metresOf(said) / (farther / 100) - 1)).toBeGreaterThan(0.01);
});

it("keeps both on a turned and tilted globe, and on a map beside it", { timeout: 240_000 }, async () => {
  const place = ecef(LONGITUDE, LATITUDE, 425);
  // From the west: north is to the left.
  await page.evaluate((at) => {
    const { viewer } = window.groma;
    const { camera } = viewer;
    const target = Object.assign(camera.positionWC.clone(), at);
    const sphere = { ...window.groma.layer.boundingSphere, center: target, radius: 1 };
    const offset = { heading: Math.PI / 2, pitch: -0.6, range: 900 };
    camera.flyToBoundingSphere(sphere as never, { duration: 0, offset: offset as never });
  }, place);
  await page.selectOption("#views", "both");
  await settle(page);
  await words();
  const picture = await shoot("both");
  const said = await words();
  const bars = said.filter((text) => /^[\d,.]+\sk?m$/.test(text));
  expect(bars.length).toBeGreaterThan(0);
  const seen = await seenOnGlobe(LONGITUDE, LATITUDE, 90);
  expect(Math.abs(barOf(picture) / metresOf(bars.slice(0, 1)) / (seen / 100) - 1)).toBeLessThan(0.01);
  expect(arrowOf(picture)).toBeCloseTo(-90, -1);

  const onMap = await page.evaluate(
    async (ends) => {
      const { map, measured } = (await window.groma.beside.view)!;
      const [a, b] = ends.map((end) => measured.project(end as never)!);
      return {
        ...{ pixels: Math.hypot(a!.x - b!.x, a!.y - b!.y), rotation: map.getView().getRotation() },
        left: map.getTargetElement().getBoundingClientRect().left,
      };
    },
    [0, 180].map((side) => geodesicFrom(LONGITUDE * DEGREE, LATITUDE * DEGREE, side * DEGREE, 50)),
  );
  const mapBar = metresOf(bars.slice(-1));
  expect(Math.abs(barOf(picture, onMap.left) / mapBar / (onMap.pixels / 100) - 1)).toBeLessThan(0.01);
  expect(arrowOf(picture, onMap.left)).toBeCloseTo(-90, -1);
  expect(onMap.rotation).toBeCloseTo(-Math.PI / 2, 1);
});

it("has all pixels of the screen, and what was measured", { timeout: 240_000 }, async () => {
  await page.selectOption("#views", "map");
  const session = await page.context().newCDPSession(page);
  await session.send("Emulation.setDeviceMetricsOverride", { ...SIZE, deviceScaleFactor: 2, mobile: false });
  await page.waitForFunction(() => devicePixelRatio === 2);
  await page.selectOption("#views", "globe");
  await lookDown(page, ecef(LONGITUDE, LATITUDE, 1425));
  await page.evaluate(() => {
    const { measure, layer } = window.groma;
    const vertex = (x: number, y: number) => {
      const [at, to, up] = layer.cloud.place(x, y, 425);
      const { longitude, latitude } = {
        longitude: 9.0064 * (Math.PI / 180),
        latitude: 45.1579 * (Math.PI / 180),
      };
      return { longitude, latitude, height: 425, ecef: [at, to, up], cloud: layer.cloud };
    };
    measure.add([
      {
        id: "note",
        kind: "annotation",
        name: "<b>Crack</b>",
        vertices: [vertex(500_500, 5_000_500)],
      } as never,
    ]);
  });
  await page.locator("#globe .groma-label").waitFor();
  await words();
  const picture = await shoot("fine");
  expect(picture.width).toBe(2 * SIZE.width);
  const said = await words();
  expect(said).toContain("<b>Crack</b>");
  const seen = await seenOnGlobe(LONGITUDE, LATITUDE, 0);
  expect(Math.abs(barOf(picture, 0, 2) / metresOf(said) / (seen / 50) - 1)).toBeLessThan(0.01);
  // The page goes on as it was.
  expect(await page.evaluate(() => window.groma.viewer.resolutionScale)).toBe(1);
  await session.send("Emulation.setDeviceMetricsOverride", { ...SIZE, deviceScaleFactor: 1, mobile: false });
  await page.waitForFunction(() => devicePixelRatio === 1);
});

it("waits for what is on its way, can be given up, and takes names for words", {
  timeout: 240_000,
}, async () => {
  const evil = "<img src=x onerror=alert(1)>\u202egnp";
  const bytes = readFileSync(join(folder, "box.copc.laz"));
  let letGo: (() => void) | undefined;
  const held = new Promise<void>((resolve) => {
    letGo = resolve;
  });
  await page.route("**/late.copc.laz", async (route) => {
    await held;
    await route.fulfill({ status: 404 });
  });
  await page.setInputFiles("#file", { name: `${evil}.copc.laz`, mimeType: "", buffer: bytes });
  await page.waitForFunction(() => window.groma.clouds.layers.length === 2);
  await page.click("#chooser summary");
  await page.fill("#address", "/late.copc.laz");
  await page.press("#address", "Enter");
  await page.locator("[aria-label='Give up late.copc.laz']").waitFor();
  await page.click("#share > summary");
  await page.click("#screenshot");
  await expect.poll(() => page.textContent("#screenshot-status")).toBe("waiting until this view is complete");
  await page.click("#screenshot");
  await expect.poll(() => page.textContent("#screenshot-status")).toBe("Nothing was written.");
  let early = true;
  const done = shoot("named").finally(() => expect(early).toBe(false));
  await expect.poll(() => page.textContent("#screenshot-status")).toBe("waiting until this view is complete");
  await words();
  early = false;
  letGo!();
  const picture = await done;
  expect(picture.width).toBe(SIZE.width);
  const shown = "<img src=x onerror=alert(1)>\\u{202e}gnp.copc.laz";
  expect((await words()).some((text) => text.startsWith(shown))).toBe(true);
  expect(await page.locator("img[src=x]").count()).toBe(0);
  expect(errors.filter((text) => !text.includes("404"))).toEqual([]);
});

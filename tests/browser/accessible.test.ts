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
  ({ page } = await openPage(browser, { width: 1000, height: 700 }, "coarse"));
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

/** Names that several landmarks or groups of the page have: whoever goes by them cannot tell these apart. */
async function ambiguous(): Promise<string[]> {
  const tree = await page.locator("body").ariaSnapshot();
  const places = /^\s*- '?(?:region|main|complementary|group|toolbar|dialog|application) ("[^"]+")/gm;
  const names = Array.from(tree.matchAll(places), ([, name]) => name!);
  expect(names.length).toBeGreaterThan(8);
  return names.filter((name, at) => names.indexOf(name) !== at);
}

it("the page with globe and map has nothing that axe objects to", { timeout: 180_000 }, async () => {
  await page.goto(`${server.address}&map=1`);
  await page.waitForFunction(() => window.groma?.layer?.settled, undefined, { timeout: 120_000 });
  expect(await violations()).toEqual([]);

  // The panel begins with five things, of which the first is unfolded.
  const folds = () =>
    page.evaluate(() =>
      Array.from(document.querySelectorAll<HTMLDetailsElement>("#body details"))
        .filter((fold) => fold.checkVisibility() && fold.matches(":not(details details)"))
        .map((fold) => [fold.querySelector("summary h2")?.textContent, fold.open]),
    );
  const five = ["Look", "Measure", "Profile", "Share"].map((name) => [name, false]);
  expect(await folds()).toEqual([["Clouds", true], ...five]);

  await page.evaluate(() => {
    for (const part of Array.from(document.querySelectorAll("details"))) part.open = true;
  });
  expect(await ambiguous()).toEqual([]);
  const text = () => page.evaluate(() => getComputedStyle(document.querySelector("#panel")!).color);
  const looks: string[] = [];
  for (const look of ["dark", "light"]) {
    await page.selectOption("#look", look);
    expect([look, ...(await violations())]).toEqual([look]);
    looks.push(await text());
    await screenshot(page, `accessible-${look}`);
  }
  expect(looks[0]).not.toBe(looks[1]);
  await page.click("#keys-open");
  expect(await violations()).toEqual([]);
  await page.keyboard.press("Escape");

  // As wide as a phone, which is 1280 px at 400 %.
  await page.setViewportSize({ width: 320, height: 640 });
  expect(await violations()).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(320);
  await screenshot(page, "accessible-320");
});

/** Elements of the page that stand out of the window, at the side. */
function outside(): Promise<string[]> {
  return page.evaluate(() =>
    Array.from(document.querySelectorAll<HTMLElement>("main, main *, aside *, dialog *"))
      .filter((element) => {
        const { left, right, width } = element.getBoundingClientRect();
        return width > 0 && (left < -1 || right > innerWidth + 1);
      })
      .map(({ tagName, id, className }) => `${tagName} #${id} .${className}`),
  );
}

it("turns round where lines run from right to left", { timeout: 60_000 }, async () => {
  await page.setViewportSize({ width: 1000, height: 700 });
  const sides = (direction: string) =>
    page.evaluate((dir) => {
      document.documentElement.dir = dir;
      const boxOf = (selector: string) => document.querySelector(selector)!.getBoundingClientRect();
      const [panel, credits] = [boxOf("#panel"), boxOf(".credits")];
      return [panel.left, innerWidth - panel.right, credits.left, innerWidth - credits.right].map(Math.round);
    }, direction);
  const [start, end, ahead, behind] = await sides("ltr");
  expect([start, behind]).toEqual([12, 12]);
  expect(await sides("rtl")).toEqual([end, start, behind, ahead]);
  expect(await outside()).toEqual([]);
  await screenshot(page, "accessible-rtl");
  await page.setViewportSize({ width: 320, height: 640 });
  expect(await outside()).toEqual([]);
  await sides("ltr");
});

it("serves readers with colours of their own, large text and no motion", { timeout: 60_000 }, async () => {
  await page.emulateMedia({ forcedColors: "active", reducedMotion: "reduce" });
  // 1280 px at 200 %.
  await page.setViewportSize({ width: 640, height: 360 });
  expect(await outside()).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(640);
  const lookOf = (pressed: boolean) =>
    page.evaluate((state) => {
      const button = document.querySelector("#walk")!;
      button.setAttribute("aria-pressed", String(state));
      return getComputedStyle(button).backgroundColor;
    }, pressed);
  expect(await lookOf(true)).not.toBe(await lookOf(false));
  await screenshot(page, "accessible-forced-colours");
  // From the click on, the camera is where it was to come.
  const pitch = await page.evaluate(() => {
    document.querySelector<HTMLElement>("#north-up")!.click();
    document.querySelector<HTMLElement>("#above")!.click();
    return new Promise<number>((resolve) => {
      window.groma.viewer.scene.postRender.addEventListener(() => resolve(window.groma.viewer.camera.pitch));
      window.groma.viewer.scene.requestRender();
    });
  });
  expect(pitch).toBeCloseTo(-Math.PI / 2, 3);
  expect(await page.evaluate(() => document.getAnimations().length)).toBe(0);
  await page.emulateMedia({ forcedColors: "none", reducedMotion: "no-preference" });
});

/** Opens what lies over globe and map besides the panel: a point, a profile with its table, an annotation that is written. */
async function openAll(): Promise<void> {
  await page.waitForFunction(() => window.groma?.layer, undefined, { timeout: 120_000 });
  await page.selectOption("#views", "globe");
  await page.waitForFunction(
    () => {
      const { viewer, layer } = window.groma;
      return viewer.canvas.width === innerWidth * viewer.resolutionScale && layer?.settled;
    },
    undefined,
    { timeout: 120_000 },
  );
  const { line, free } = await page.evaluate(() => {
    const { viewer, layer } = window.groma;
    const at = (x: number, y: number) => {
      const [px, py, pz] = layer.cloud.place(x, y, 25);
      return Object.assign(viewer.camera.positionWC.clone(), { x: px, y: py, z: pz });
    };
    const ends = [at(100, 500), at(900, 500)].map((place) => {
      const { longitude, latitude } = viewer.scene.globe.ellipsoid.cartesianToCartographic(place);
      return [longitude, latitude].map((angle) => angle * (180 / Math.PI));
    });
    for (const part of Array.from(document.querySelectorAll("details"))) part.open = true;
    // A place of the cloud that nothing lies over.
    const steps = [1, 2, 3, 4, 5, 6, 7, 8, 9];
    const places = steps.flatMap((x) => steps.map((y) => at(100 * x, 100 * y)));
    const pixels = places.map((place) => viewer.scene.cartesianToCanvasCoordinates(place)!);
    const free = pixels.find(({ x, y }) => document.elementFromPoint(x, y) === viewer.canvas)!;
    return { line: { type: "LineString", coordinates: ends }, free: { x: free.x, y: free.y } };
  });
  await page.mouse.click(free.x, free.y);
  await page.waitForSelector("#picked:not([hidden])");
  const buffer = Buffer.from(JSON.stringify(line));
  await page.setInputFiles("#profile-file", { name: "line.geojson", mimeType: "", buffer });
  await page.waitForFunction(
    () => (window.groma as unknown as { profile: { shown: number } }).profile.shown > 0,
  );
  await page.check("#profile-table-shown");
  await page.waitForSelector("#profile-table tbody tr");
}

it("asks before another language loses what was measured", { timeout: 180_000 }, async () => {
  const note = () => page.textContent("#language-note");
  await page.evaluate(() => {
    const { measure, layer } = window.groma;
    const [longitude, latitude, height] = [0.1, 0, 1];
    const place = { ...{ longitude, latitude, height }, ecef: [6_300_000, 630_000, 0] as const };
    measure.add([
      { id: "kept", kind: "point", name: "7", vertices: [{ ...place, cloud: layer.cloud } as never] },
    ]);
  });
  await page.selectOption("#language", "ja");
  expect(await note()).toContain("measurements that are not saved are lost");
  expect(await page.getAttribute("html", "lang")).toBe("en");
  await page.evaluate(() => window.groma.measure.remove("kept"));
  await page.selectOption("#language", "en");
  expect(await note()).toBe("");
  await page.selectOption("#language", "ja");
  await page.waitForFunction(() => document.documentElement.lang === "ja");
  // Every screen in another language, with all that can be open; then as wide as a phone, and with a reader's colours.
  await page.setViewportSize({ width: 1000, height: 700 });
  await page.waitForSelector("#language");
  await openAll();
  expect(await ambiguous()).toEqual([]);
  expect(await violations()).toEqual([]);
  await screenshot(page, "accessible-all-ja");
  await page.emulateMedia({ forcedColors: "active" });
  await page.setViewportSize({ width: 320, height: 640 });
  expect(await violations()).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(320);
  await screenshot(page, "accessible-all-320");
  await page.emulateMedia({ forcedColors: "none" });
  await page.setViewportSize({ width: 1000, height: 700 });
  await page.selectOption("#language", "en");
  await page.waitForFunction(() => document.documentElement.lang === "en");
  await openAll();
  expect(await violations()).toEqual([]);
});

it("the first screen asks for a scan, and opens its own sample", { timeout: 180_000 }, async () => {
  await page.setViewportSize({ width: 1000, height: 700 });
  await page.goto(new URL("/", server.address).href);
  await page.waitForSelector("body.empty");
  // The look that was chosen before is kept.
  expect(await page.inputValue("#look")).toBe("light");
  expect(await violations()).toEqual([]);
  const box = await page.locator("#panel").boundingBox();
  expect(box!.x + box!.width / 2).toBeCloseTo(500, 0);
  await screenshot(page, "first-screen");
  // On a phone the globe is seen whole above it.
  await page.setViewportSize({ width: 390, height: 844 });
  const [globe, panel] = await page.evaluate(() =>
    ["globe", "panel"].map((id) => document.getElementById(id)!.getBoundingClientRect().toJSON()),
  );
  expect([globe.top, globe.bottom, panel.bottom]).toEqual([0, panel.top, 844]);
  expect(globe.height).toBeGreaterThan(0.35 * 844);
  expect(await outside()).toEqual([]);
  await screenshot(page, "first-screen-phone");
  await page.setViewportSize({ width: 1000, height: 700 });
  await page.click("#sample");
  await page.waitForFunction(() => window.groma?.layer?.settled, undefined, { timeout: 120_000 });
  expect(await page.textContent("#title")).toBe("sample.copc.laz");
  expect(await page.isVisible("#welcome")).toBe(false);
  await screenshot(page, "first-sample");
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

import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data, projectRoot } from "../project.js";
import { settle } from "./globe.js";
import { openPage, sharedBrowser, type View, view } from "./harness.js";

const [autzen, fields] = [data("autzen.laz"), data("vol_total.laz")];
const asked = process.env.GROMA_PICTURES === "1";
const left = asked ? (autzen.missing ?? fields.missing) : "GROMA_PICTURES=1 makes them anew, two minutes";

const size = { width: 1200, height: 750 };

/** Keeps what the page shows as a picture of the manual. */
async function keep(page: Page, name: string, area?: { x: number; width: number }): Promise<void> {
  const path = join(projectRoot, "docs/images", `${name}.jpg`);
  const clip = area && { y: 0, height: size.height, ...area };
  await page.screenshot({ path, type: "jpeg", quality: 80, ...(clip && { clip }), timeout: 120_000 });
}

/** Right of the panel. */
const SCENE = { x: 320, width: size.width - 320 };

/** Where the window shows points along the middle of the scan, at shares of its length. */
function pixelsAt(page: Page, shares: readonly number[]): Promise<{ x: number; y: number }[]> {
  return page.evaluate(async (all) => {
    const { layer, viewer } = window.groma;
    const { min, max } = layer.cloud.boundingBox;
    const key = "0-0-0-0";
    const { count } = await layer.cloud.loadNode(key);
    const points: (readonly [number, number, number])[] = [];
    for (let record = 0; record < count; record += 50) {
      points.push((await layer.cloud.readPoint(key, { record })).source);
    }
    return all.map((share) => {
      const [x, y] = [min[0] + share * (max[0] - min[0]), (min[1] + max[1]) / 2];
      const off = (point: readonly number[]) => Math.hypot(point[0]! - x, point[1]! - y);
      const nearest = points.reduce((best, point) => (off(point) < off(best) ? point : best));
      const [i, j, k] = layer.cloud.place(...nearest);
      const pixel = viewer.scene.cartesianToCanvasCoordinates({ x: i, y: j, z: k } as never)!;
      return { x: pixel.x, y: pixel.y };
    });
  }, shares);
}

describe.skipIf(left)(`pictures of the manual${left ? ` (skipped: ${left})` : ""}`, () => {
  let browser: Browser;
  const servers: View[] = [];
  async function open(scan: string, query: string): Promise<Page> {
    const server = await view(converted(scan));
    servers.push(server);
    const { page } = await openPage(browser, size, "whole");
    await page.goto(`${server.address}&fly=0&${query}`);
    await settle(page);
    return page;
  }

  beforeAll(async () => {
    browser = await sharedBrowser();
  }, 240_000);

  afterAll(async () => {
    await browser?.close();
    for (const server of servers) await server.stop();
  });

  it("of a town, in its colours and by height", { timeout: 280_000 }, async () => {
    const page = await open(autzen.path, "budget=1500000");
    await keep(page, "autzen");
    await page.evaluate(() => {
      window.groma.layer.style = {
        color: "elevation",
        size: "adaptive",
        shape: "disc",
        eyeDomeLighting: true,
      };
    });
    await settle(page);
    await keep(page, "eye-dome", SCENE);
  });

  it("of a profile, and of globe and map", { timeout: 280_000 }, async () => {
    const page = await open(fields.path, "budget=500000&vertical=EPSG:5728&size=3");
    await page.click("#clouds > summary");
    await page.click("#profiles > summary");
    await page.click("#profile-draw");
    await page.fill("#profile-width", "3");
    for (const { x, y } of await pixelsAt(page, [0.2, 0.5, 0.8])) {
      const before = await page.evaluate(() => window.groma.profile.line.length);
      await page.mouse.click(x, y);
      await page.waitForFunction((count) => window.groma.profile.line.length > count, before);
    }
    await page.click("#profile-draw");
    await page.waitForFunction(() =>
      /complete$/.test(document.querySelector("#profile-status")!.textContent!),
    );
    await settle(page);
    await keep(page, "profile");
    await page.click("#profile-close");
    await page.selectOption("#views", "both");
    await page.evaluate(async () => {
      const { map } = (await window.groma.beside.view)!;
      await new Promise<void>((done) => {
        map.once("rendercomplete", () => done());
        map.render();
      });
    });
    await settle(page);
    await keep(page, "globe-and-map");
    expect(await page.isVisible("#map canvas")).toBe(true);
  });
});

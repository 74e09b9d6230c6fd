import type { Page } from "playwright-core";
import { expect } from "vitest";
import { converted } from "../../converted.js";
import { settle } from "../globe.js";
import { openPage, sharedBrowser, view } from "../harness.js";

/** A place of the window where a view finds a point, with the point. */
export interface Hit {
  readonly x: number;
  readonly y: number;
  readonly integers: readonly number[];
  readonly ecef: readonly number[];
}

/** Height of the terrain everywhere, metres above the ellipsoid. */
export const TERRAIN = 700;

/** A terrain of one height, as heightmap-1.0 has it. */
async function serveTerrain(page: Page): Promise<void> {
  const layer = {
    ...{ tilejson: "2.1.0", format: "heightmap-1.0", version: "1.0.0", scheme: "tms" },
    tiles: ["{z}/{x}/{y}.terrain"],
    available: [[{ startX: 0, startY: 0, endX: 1, endY: 0 }]],
  };
  // 65 × 65 heights in fifths of a metre from −1,000 m on, no children, all land.
  const heights = new Uint16Array(65 * 65).fill(5 * (TERRAIN + 1000));
  const tile = Buffer.concat([Buffer.from(heights.buffer), Buffer.from([0, 0])]);
  await page.route("**/terrain/layer.json", (route) => route.fulfill({ json: layer }));
  await page.route("**/terrain/0/**", (route) => route.fulfill({ body: tile }));
}

export type Which = "globe" | "map";

/** The page with globe and map beside each other, and what tests do there: one for all of them, since loading takes most of the time. */
export type MeasuringStage = Awaited<ReturnType<typeof openMeasuring>>;

/** @param scan that is measured */
export async function openMeasuring(scan: string) {
  const server = await view(converted(scan));
  const browser = await sharedBrowser();
  const { page, watch } = await openPage(browser, { width: 1080, height: 400 });
  const session = await page.context().newCDPSession(page);
  await serveTerrain(page);
  /** Waits for both views. */
  async function ready(map = true): Promise<void> {
    await settle(page);
    await page.evaluate(async (mapShows) => {
      const { beside } = window.groma;
      document.querySelectorAll("details").forEach((one) => {
        one.open = one.closest("#measuring, #share") !== null;
      });
      const { map } = (await beside.view)!;
      if (!mapShows) return;
      await new Promise<void>((resolve) => {
        map.once("rendercomplete", () => resolve());
        map.render();
      });
    }, map);
  }

  /** Integers of the records that the vertices of each measurement stand on. */
  const records = () =>
    page.evaluate(() =>
      window.groma.measure.measurements.map(({ vertices }) => vertices.map(({ record }) => record?.integers)),
    );
  const entries = () => page.locator("#measurements > li");
  const tool = (name: string) => page.locator(`#measure-tools button:text-is('${name}')`);
  const drawn = (count: number) =>
    page.waitForFunction((wanted) => window.groma.measure.drawn === wanted, count);
  const measured = (count: number) =>
    page.waitForFunction((wanted) => window.groma.measure.measurements.length === wanted, count);
  /** Waits until a vertex of the last measurement is another record. */
  const moved = (vertex: number, was: readonly number[]) =>
    page.waitForFunction(
      ([at, before]) =>
        window.groma.measure.measurements.at(-1)!.vertices[at]!.record?.integers.join() !== before,
      [vertex, was.join()] as const,
    );
  const tap = async ({ x, y }: { readonly x: number; readonly y: number }) => {
    await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
    await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  };
  const press = async (...keys: string[]) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  const clear = () =>
    page.evaluate(() => {
      const { measure } = window.groma;
      measure.cancel();
      for (const { id } of measure.measurements) measure.remove(id);
    });
  /** Draws a line of several places by mouse. */
  async function line(...way: readonly { readonly x: number; readonly y: number }[]): Promise<void> {
    const before = (await records()).length;
    await tool("Line").click();
    for (const [i, { x, y }] of way.entries()) {
      await page.mouse.click(x, y);
      await drawn(i + 1);
    }
    await page.evaluate(() => window.groma.measure.finish());
    await measured(before + 1);
  }

  // A link of a later version: told by name, and the cloud is there all the same.
  await page.goto(`${server.address}&map=1&link=0&fly=0&budget=60000&terrain=/terrain/#view=1~x9`);
  await ready();
  const message = page.locator("#message");
  expect(await message.textContent()).toContain('"x9"');
  await message.locator("button").last().click();
  const places: Readonly<Record<Which, readonly Hit[]>> = await page.evaluate(async () => {
    const { beside, layer, viewer } = window.groma;
    const { map, measured } = (await beside.view)!;
    const signal = new AbortController().signal;
    const found: Record<"globe" | "map", Hit[]> = { globe: [], map: [] };
    const { left } = map.getViewport().getBoundingClientRect();
    const far = (hits: Hit[], x: number, y: number) =>
      hits.every((one) => Math.hypot(one.x - x, one.y - y) > 34);
    for (let y = 130; y < 330 && found.globe.length < 4; y += 30) {
      for (let x = viewer.canvas.clientWidth - 30; x > 360 && found.globe.length < 4; x -= 30) {
        const hit = far(found.globe, x, y) && (await layer.pick({ x, y }, { window: 15 }));
        const { x: X, y: Y, z: Z } = hit ? hit.position : viewer.camera.positionWC;
        if (hit) found.globe.push({ x, y, integers: hit.integers, ecef: [X, Y, Z] });
      }
    }
    for (const [x, y] of [
      [120, 180],
      [220, 200],
      [230, 240],
      [140, 235],
    ] as const) {
      const vertex = await measured.pick({ x, y }, 7, signal);
      if (vertex?.record) {
        found.map.push({ x: x + left, y, integers: vertex.record.integers, ecef: vertex.ecef });
      }
    }
    return found;
  });
  expect([places.globe.length, places.map.length]).toEqual([4, 4]);
  const close = async () => {
    await browser.close();
    await server.stop();
  };
  return {
    ...{ page, watch, session, places, close },
    ...{ ready, records, entries, tool, drawn, measured, moved, tap, press, clear, line },
  };
}

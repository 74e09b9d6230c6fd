import { readFileSync } from "node:fs";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { settle } from "./globe.js";
import { launch, openPage, screenshot, type View, view } from "./harness.js";

const scan = data("vol_total.laz");

/** A place of the canvas where a point is drawn, with the point. */
interface Hit {
  readonly x: number;
  readonly y: number;
  readonly integers: readonly number[];
  readonly ecef: readonly number[];
}

/** Places beside the panel, far apart, where the layer finds points. */
async function hits(page: Page): Promise<Hit[]> {
  return page.evaluate(async () => {
    const { layer } = window.groma;
    const found: Hit[] = [];
    for (const [x, y] of [
      [420, 300],
      [700, 330],
      [620, 420],
      [560, 250],
    ]) {
      for (let step = 0; step < 12; step++) {
        const at = { x: x! + 9 * step, y: y! };
        const hit = await layer.pick(at, { window: 15 });
        if (!hit) continue;
        const { position } = hit;
        found.push({ ...at, integers: hit.integers, ecef: [position.x, position.y, position.z] });
        break;
      }
    }
    return found;
  });
}

/** Integers of the records that the vertices of each measurement stand on. */
function records(page: Page): Promise<(readonly number[] | undefined)[][]> {
  return page.evaluate(() =>
    window.groma.measure.measurements.map(({ vertices }) => vertices.map(({ record }) => record?.integers)),
  );
}

const entries = (page: Page) => page.locator("#measurements > li");

describe.skipIf(scan.missing)(`measuring on the globe${scan.missing ? ` (${scan.missing})` : ""}`, () => {
  let server: View;
  let browser: Browser;

  beforeAll(async () => {
    server = await view(converted(scan.path));
    browser = await launch();
  }, 240_000);

  afterAll(async () => {
    await browser?.close();
    await server?.stop();
  });

  it("by mouse: draw, drag, undo, save, load again", { timeout: 400_000 }, async () => {
    const { page, watch } = await openPage(browser, { width: 960, height: 600 });
    await page.goto(server.address);
    await settle(page);
    await page.evaluate(() => {
      document.querySelectorAll("details").forEach((one) => {
        one.open = one.id === "measuring";
      });
    });
    const [a, b, c] = await hits(page);
    await page.click("#measure-tools button:text-is('Distance')");
    await page.mouse.click(a!.x, a!.y);
    await page.waitForFunction(() => window.groma.measure.drawn === 1);
    await page.mouse.move(b!.x - 5, b!.y - 5);
    await page.mouse.click(b!.x, b!.y);
    await entries(page).first().waitFor();
    expect(await records(page)).toEqual([[a!.integers, b!.integers]]);
    // The record's panel stays closed: clicks were for measuring.
    expect(await page.locator("#picked").isHidden()).toBe(true);
    const apart = Math.hypot(...a!.ecef.map((value, axis) => value - b!.ecef[axis]!));
    const words = (await entries(page).first().locator("dd").first().textContent())!;
    expect(Number.parseFloat(words.replaceAll(",", ""))).toBeCloseTo(apart, 2);
    expect(words).toContain("at least ±");
    expect(await page.locator(".groma-label").first().textContent()).toContain(words.split(" ")[0]);

    // A precision that the reader gives makes the worth whole; feet are feet.
    await page.fill("#measure-precision", "20");
    await page.press("#measure-precision", "Tab");
    await page.selectOption("#measure-units", "US survey feet");
    const feet = (await entries(page).first().locator("dd").first().textContent())!;
    expect(feet).toMatch(/ftUS ± 0\.\d\d\sftUS$/);
    expect(feet).not.toContain("at least");
    expect(Number.parseFloat(feet.replaceAll(",", ""))).toBeCloseTo((apart * 3937) / 1200, 1);

    await page.click("button[aria-label='Edit Distance 1']");
    await page.mouse.move(b!.x, b!.y);
    await page.mouse.down();
    await page.mouse.move(c!.x - 20, c!.y, { steps: 3 });
    await page.mouse.move(c!.x, c!.y);
    await page.mouse.up();
    await page.waitForFunction(
      (was) => window.groma.measure.measurements[0]!.vertices[1]!.record?.integers.join() !== was,
      b!.integers.join(),
    );
    const [[, moved] = []] = await records(page);
    expect(moved).toEqual(c!.integers);
    await screenshot(page, "measuring-distance");
    await page.click("#measure-undo");
    expect(await records(page)).toEqual([[a!.integers, b!.integers]]);
    await page.click("#measure-redo");
    expect(await records(page)).toEqual([[a!.integers, c!.integers]]);

    await page.click("#measure-tools button:text-is('Area')");
    for (const { x, y } of [a!, b!, c!]) {
      await page.mouse.click(x, y);
      await page.waitForTimeout(400);
    }
    await page.mouse.click(a!.x, a!.y);
    await page.waitForFunction(() => window.groma.measure.measurements.length === 2);
    await screenshot(page, "measuring-area");
    const download = page.waitForEvent("download");
    await page.click("#measure-save");
    const path = await (await download).path();
    const saved = JSON.parse(readFileSync(path, "utf8"));
    expect(saved.features.map(({ geometry }: { geometry: { type: string } }) => geometry.type)).toEqual([
      "LineString",
      "Polygon",
    ]);
    const before = await records(page);

    // A link brings back how the cloud is seen, and what is selected.
    const bare = await page.evaluate(async () => {
      const { layer, measure, viewer } = window.groma;
      measure.edit(undefined);
      for (let x = 420; x < 800; x += 7) {
        for (const y of [300, 330, 360]) {
          const hit =
            document.elementFromPoint(x, y) === viewer.canvas && (await layer.pick({ x, y }, { window: 3 }));
          if (hit) return { x, y };
        }
      }
      return undefined;
    });
    await page.mouse.click(bare!.x, bare!.y);
    await page.locator("#picked").waitFor();
    const view = () =>
      page.evaluate(() => {
        const { layer, viewer } = window.groma;
        const { positionWC: at, heading, pitch } = viewer.camera;
        return {
          camera: [at.x, at.y, at.z, 1000 * heading, 1000 * pitch],
          shown: [layer.style.color, layer.style.eyeDomeLighting, layer.filter, [...layer.clips]],
          picked: document.querySelector("#picked-facts")!.textContent,
        };
      });
    await page.evaluate(() => {
      const { layer, viewer } = window.groma;
      layer.style = { color: "intensity", eyeDomeLighting: true };
      layer.filter = { ranges: { intensity: [1, Number.POSITIVE_INFINITY] } };
      const { longitude, latitude } = viewer.camera.positionCartographic;
      const center = { longitude, latitude, height: 400 };
      layer.clips.add({
        ...{ kind: "box", mode: "highlight", center, size: [9, 8, 7] as const },
        ...{ heading: 0.5, pitch: 0, roll: 0 },
      });
      viewer.camera.moveForward(20);
    });
    await page.click("#copy-link");
    await page.locator("#link-note:has-text('link')").waitFor();
    expect(page.url()).toMatch(/#view=1~c[-\d._]+~s\w+~f\w+~k[\w-]+~p[\d-]+_\d+$/);
    const seen = await view();

    await page.reload();
    await settle(page);
    await page.locator("#picked").waitFor();
    const again = await view();
    expect([again.shown, again.picked]).toEqual([seen.shown, seen.picked]);
    for (const [i, value] of seen.camera.entries()) {
      expect(Math.abs(again.camera[i]! - value)).toBeLessThan(i < 3 ? 0.05 : 0.2);
    }
    await page.setInputFiles("#measure-file", path);
    await page.waitForFunction(() => window.groma.measure.measurements.length === 2);
    expect(await records(page)).toEqual(before);
    expect(watch.errors).toEqual([]);
    expect(watch.foreign).toEqual([]);
    await page.context().close();
  });

  it("by keyboard alone: draw, move a vertex, give up, undo", { timeout: 280_000 }, async () => {
    const { page, watch } = await openPage(browser, { width: 960, height: 600 });
    await page.goto(server.address);
    await settle(page);
    await page.evaluate(() => {
      document.querySelectorAll("details").forEach((one) => {
        one.open = one.id === "measuring";
      });
    });
    // Places that the crosshair comes to from the middle, in steps of 10 pixels.
    const ways = await page.evaluate(async () => {
      const { layer, viewer } = window.groma;
      const { clientWidth, clientHeight } = viewer.canvas;
      const found: [number, number][] = [];
      for (const [right, down] of [
        [6, 0],
        [12, 4],
        [12, 9],
        [9, 6],
        [16, 2],
        [20, 8],
      ] as [number, number][]) {
        const at = { x: clientWidth / 2 + 10 * right, y: clientHeight / 2 + 10 * down };
        if (await layer.pick(at, { window: 15 })) found.push([right, down]);
      }
      return found;
    });
    expect(ways.length).toBeGreaterThanOrEqual(3);
    let [across, below] = [0, 0];
    const go = async (way: [number, number]) => {
      const [right, down] = [way[0] - across, way[1] - below];
      [across, below] = way;
      await press(
        ...times(right < 0 ? "ArrowLeft" : "ArrowRight", Math.abs(right)),
        ...times(down < 0 ? "ArrowUp" : "ArrowDown", Math.abs(down)),
        "Enter",
      );
    };
    const press = async (...keys: string[]) => {
      for (const key of keys) await page.keyboard.press(key);
    };
    const times = (key: string, count: number) => Array.from({ length: count }, () => key);
    await page.focus("#measure-tools button:text-is('Line')");
    await press("Enter");
    await go(ways[0]!);
    await page.waitForFunction(() => window.groma.measure.drawn === 1);
    await go(ways[1]!);
    await page.waitForFunction(() => window.groma.measure.drawn === 2);
    await go(ways[2]!);
    await page.waitForFunction(() => window.groma.measure.drawn === 3);
    await screenshot(page, "measuring-keyboard");
    // Once more in the same place ends the line.
    await press("Enter");
    await page.waitForFunction(() => window.groma.measure.measurements.length === 1);
    const [before] = await records(page);
    expect(new Set(before!.map(String)).size).toBe(3);

    await page.focus("button[aria-label='Edit Line 1']");
    await press("Enter");
    await page.focus("circle[aria-label='Vertex 2 of Line 1']");
    await press("ArrowUp");
    await page.waitForFunction(
      (was) => window.groma.measure.measurements[0]!.vertices[1]!.record?.integers.join() !== was,
      before![1]!.join(),
    );
    await press("Delete");
    expect((await records(page))[0]).toEqual([before![0], before![2]]);
    await press("Control+z", "Control+z");
    expect((await records(page))[0]).toEqual(before);

    await page.focus("#measure-tools button:text-is('Area')");
    await press("Enter", "Enter");
    await page.waitForFunction(() => window.groma.measure.drawn === 1);
    await press("Escape");
    expect(await page.evaluate(() => window.groma.measure.drawing)).toBeUndefined();
    expect(await records(page)).toEqual([before]);
    expect(watch.errors).toEqual([]);
    await page.context().close();
  });

  it("by touch, begun on the globe and ended on the map", { timeout: 280_000 }, async () => {
    const { page, watch } = await openPage(browser, { width: 1200, height: 600 });
    // A link of a later version: told by name, and the cloud is there all the same.
    await page.goto(`${server.address}&map=1&link=0&fly=0#view=1~x9`);
    await settle(page);
    const message = page.locator("#message");
    await message.waitFor();
    expect(await message.textContent()).toContain('"x9"');
    await message.locator("button").last().click();
    await page.evaluate(() => {
      document.querySelectorAll("details").forEach((one) => {
        one.open = one.id === "measuring";
      });
    });
    await settleMap(page);
    /** Places of the window where each view finds a point. */
    const places = await page.evaluate(async () => {
      const { beside, layer, viewer } = window.groma;
      const { map, measured } = (await beside.view)!;
      const signal = new AbortController().signal;
      const found: Record<"globe" | "map", { x: number; y: number; integers: readonly number[] }[]> = {
        globe: [],
        map: [],
      };
      const left = map.getViewport().getBoundingClientRect().left;
      for (let step = 0; step < 40; step++) {
        const at = { x: viewer.canvas.clientWidth - 40 - 9 * step, y: 290 };
        const hit = found.globe.length < 1 && (await layer.pick(at, { window: 15 }));
        if (hit) found.globe.push({ ...at, integers: hit.integers });
      }
      for (const [x, y] of [
        [100, 280],
        [160, 300],
        [170, 360],
        [90, 350],
      ] as const) {
        const record = (await measured.pick({ x, y }, 7, signal))?.record;
        if (record) found.map.push({ x: x + left, y, integers: record.integers });
      }
      return found;
    });
    const [a, b] = [places.globe[0]!, places.map[0]!];
    expect(places.map.length).toBe(4);
    const session = await page.context().newCDPSession(page);
    await session.send("Emulation.setTouchEmulationEnabled", { enabled: true });
    const tap = async ({ x, y }: { x: number; y: number }) => {
      await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: [{ x, y }] });
      await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    };
    await page.click("#measure-tools button:text-is('Distance')");
    await tap(a);
    await page.waitForFunction(() => window.groma.measure.drawn === 1);
    await tap(b);
    await entries(page).first().waitFor();
    expect(await records(page)).toEqual([[a.integers, b.integers]]);
    await screenshot(page, "measuring-both");
    const labels = page.locator(".groma-label:visible");
    expect(await labels.count()).toBe(2);
    expect(await labels.nth(1).textContent()).toBe(await labels.nth(0).textContent());
    // Two taps at once would zoom the map; while a figure is drawn they end it.
    await page.click("#measure-tools button:text-is('Line')");
    const zoom = () => page.evaluate(async () => (await window.groma.beside.view)!.map.getView().getZoom());
    const before = await zoom();
    await tap(a);
    await tap(b);
    await tap(b);
    await page.waitForFunction(() => window.groma.measure.measurements.length === 2);
    await page.waitForTimeout(500);
    expect(await zoom()).toBe(before);
    await page.click("button[aria-label='Delete Line 1']");
    await page.click("#measure-undo");
    expect((await records(page))[1]).toEqual([a.integers, b.integers]);
    // A volume is read after it is drawn, and read anew when it is measured against something else.
    await page.click("#measure-tools button:text-is('Volume')");
    for (const [placed, corner] of places.map.entries()) {
      await tap(corner);
      await page.waitForFunction((count) => window.groma.measure.drawn === count, placed + 1);
    }
    await tap(places.map[0]!);
    const volume = entries(page).last();
    await volume.locator("dt:text-is('net')").waitFor();
    const net = () => volume.locator("dd").first().textContent();
    const lowest = await net();
    expect(lowest).toMatch(/m³/);
    await screenshot(page, "measuring-volume");
    await volume.locator("select").selectOption("highest");
    await volume.locator("dt:text-is('net')").waitFor();
    await expect.poll(net).not.toBe(lowest);
    expect(await net()).toMatch(/^−/);
    await page.click("#measure-undo");
    await expect.poll(net).toBe(lowest);
    expect(await volume.locator("select").inputValue()).toBe("lowest");
    await page.click("#measurements > li .name");
    await page.waitForFunction(
      async (was) => (await window.groma.beside.view)!.map.getView().getZoom() !== was,
      before,
    );
    expect(watch.errors).toEqual([]);
    expect(watch.foreign).toEqual([]);
    await page.context().close();
  });
});

/** Waits until the map shows all that it wants. */
async function settleMap(page: Page): Promise<void> {
  await page.evaluate(async () => {
    const { map } = (await window.groma.beside.view)!;
    await new Promise<void>((resolve) => {
      map.once("rendercomplete", () => resolve());
      map.render();
    });
  });
}

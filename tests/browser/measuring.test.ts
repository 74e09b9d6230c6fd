import { copyFileSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, CDPSession, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view, type Watch } from "./harness.js";

const scan = data("vol_total.laz");

/** A place of the window where a view finds a point, with the point. */
interface Hit {
  readonly x: number;
  readonly y: number;
  readonly integers: readonly number[];
  readonly ecef: readonly number[];
}

/** Height of the terrain everywhere, metres above the ellipsoid. */
const TERRAIN = 700;

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

type Which = "globe" | "map";

// One page for all: loading it and drawing the globe take most of the time.
describe.skipIf(scan.missing)(`measuring on globe and map${scan.missing ? ` (${scan.missing})` : ""}`, () => {
  let server: View;
  let browser: Browser;
  let page: Page;
  let watch: Watch;
  let session: CDPSession;
  let places: Readonly<Record<Which, readonly Hit[]>>;

  beforeAll(async () => {
    server = await view(converted(scan.path));
    browser = await sharedBrowser();
    ({ page, watch } = await openPage(browser, { width: 1080, height: 400 }));
    session = await page.context().newCDPSession(page);
    await serveTerrain(page);
    // A link of a later version: told by name, and the cloud is there all the same.
    await page.goto(`${server.address}&map=1&link=0&fly=0&budget=60000&terrain=/terrain/#view=1~x9`);
    await ready();
    const message = page.locator("#message");
    expect(await message.textContent()).toContain('"x9"');
    await message.locator("button").last().click();
    places = await page.evaluate(async () => {
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
  }, 400_000);

  afterAll(async () => {
    await browser?.close();
    await server?.stop();
  });

  /** Has the globe draw on demand only, as measuring asks it to: else it takes the processor from all the rest. */
  async function onDemand(): Promise<void> {
    await page.waitForFunction(() => window.groma !== undefined);
    await page.evaluate(() => {
      window.groma.viewer.scene.requestRenderMode = true;
    });
  }

  /** Waits for both views. */
  async function ready(map = true): Promise<void> {
    await onDemand();
    await settle(page);
    await page.evaluate(async (mapShows) => {
      const { beside } = window.groma;
      document.querySelectorAll("details").forEach((one) => {
        one.open = one.id === "measuring";
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

  it("by mouse: draw, in units and worth, drag a vertex on either view, undo", {
    timeout: 280_000,
  }, async () => {
    const [[a, b, c], [, , d]] = [places.globe, places.map];
    await tool("Distance").click();
    await page.mouse.click(a!.x, a!.y);
    await drawn(1);
    await page.mouse.click(b!.x, b!.y);
    await entries().first().waitFor();
    expect(await records()).toEqual([[a!.integers, b!.integers]]);
    // The record's panel stays closed: clicks were for measuring.
    expect(await page.locator("#picked").isHidden()).toBe(true);
    const apart = Math.hypot(...a!.ecef.map((value, axis) => value - b!.ecef[axis]!));
    const value = async () => (await entries().first().locator("dd").first().textContent())!;
    const words = await value();
    expect(Number.parseFloat(words.replaceAll(",", ""))).toBeCloseTo(apart, 2);
    expect(words).toContain("at least ±");
    expect(await page.locator(".groma-label").first().textContent()).toContain(words.split(" ")[0]);

    // A precision that the reader gives makes the worth whole; feet are feet.
    await page.fill("#measure-precision", "20");
    await page.press("#measure-precision", "Tab");
    await page.selectOption("#measure-units", "US survey feet");
    expect(await value()).toMatch(/ftUS ± 0\.\d\d\sftUS$/);
    expect(await value()).not.toContain("at least");
    expect(Number.parseFloat((await value()).replaceAll(",", ""))).toBeCloseTo((apart * 3937) / 1200, 1);
    await page.selectOption("#measure-units", "metres");

    // Its label lies neither under the panel nor on its own line.
    const free = await page.evaluate(() => {
      const panel = document.querySelector("#panel")!.getBoundingClientRect();
      const [first, second] = Array.from(document.querySelectorAll(".groma-measure circle")).map((dot) =>
        dot.getBoundingClientRect(),
      );
      const label = document.querySelector(".groma-label")!.getBoundingClientRect();
      const hidden = Array.from({ length: 200 }, (_, i) => i / 199).some((share) => {
        const x = first!.x + 3.5 + share * (second!.x - first!.x);
        const y = first!.y + 3.5 + share * (second!.y - first!.y);
        return x > label.left && x < label.right && y > label.top && y < label.bottom;
      });
      return [label.left >= panel.right, hidden];
    });
    expect(free).toEqual([true, false]);

    await page.click("button[aria-label='Edit Distance 1']");
    const drag = async (from: { x: number; y: number }, to: { x: number; y: number }) => {
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(to.x - 3, to.y, { steps: 2 });
      await page.mouse.move(to.x, to.y);
      await page.mouse.up();
    };
    await drag(b!, c!);
    await moved(1, b!.integers);
    expect(await records()).toEqual([[a!.integers, c!.integers]]);
    await screenshot(page, "measuring-distance");
    await tool("Undo").click();
    expect(await records()).toEqual([[a!.integers, b!.integers]]);
    await tool("Redo").click();
    expect(await records()).toEqual([[a!.integers, c!.integers]]);
    // The same vertex, taken hold of on the map.
    const onMap = await page
      .locator("#map circle[aria-label='Vertex 2 of Distance 1']")
      .evaluate((circle) => circle.getBoundingClientRect().toJSON());
    await drag({ x: onMap.x + onMap.width / 2, y: onMap.y + onMap.height / 2 }, d!);
    await moved(1, c!.integers);
    expect(await records()).toEqual([[a!.integers, d!.integers]]);
    await tool("Undo").click();
    expect(await records()).toEqual([[a!.integers, c!.integers]]);
    await press("Escape");
    await clear();
  });

  it("snaps to vertices before points, and to edges where there is none, on both", {
    timeout: 280_000,
  }, async () => {
    for (const which of ["globe", "map"] as const) {
      const [a, b, c, d] = places[which];
      await line(a!, b!);
      // Six pixels beside a vertex it is that vertex.
      await line(c!, { x: b!.x + 4, y: b!.y + 4 });
      expect((await records()).at(-1)).toEqual([c!.integers, b!.integers]);
      await line(d!, c!);
      // Nothing shows, and no point is there: what was measured is.
      await page.evaluate(() => {
        window.groma.layer.show = false;
        window.groma.viewer.scene.requestRender();
      });
      await page.waitForTimeout(300);
      const before = (await records()).length;
      await tool("Line").click();
      await page.mouse.click((a!.x + b!.x) / 2, (a!.y + b!.y) / 2 + 3);
      await drawn(1);
      const onEdge = await page.evaluate(() => {
        const { measure } = window.groma;
        const [first] = measure.measurements;
        const [from, to] = first!.vertices.map(({ ecef }) => ecef);
        const at = measure.drawnVertices[0]!;
        const [reach, part] = [to!, at.ecef].map((one) => one.map((value, axis) => value - from![axis]!));
        const length = Math.hypot(...reach!);
        const along = part!.reduce((sum, value, axis) => sum + (value * reach![axis]!) / length, 0);
        const off = Math.sqrt(Math.max(0, part!.reduce((sum, value) => sum + value * value, 0) - along ** 2));
        return { record: at.record !== undefined, share: along / length, off };
      });
      expect(onEdge.record).toBe(false);
      expect(onEdge.off).toBeLessThan(0.01);
      expect(onEdge.share).toBeGreaterThan(0.3);
      expect(onEdge.share).toBeLessThan(0.7);
      await page.mouse.click(a!.x - 3, a!.y);
      await drawn(2);
      // Where there is nothing at all, nothing is placed, and the figure says so.
      await page.mouse.click(a!.x, 60);
      await page.locator(".groma-label:has-text('no point here')").first().waitFor();
      await page.evaluate(() => window.groma.measure.finish());
      await measured(before + 1);
      expect((await records()).at(-1)).toEqual([undefined, a!.integers]);
      await page.evaluate(() => {
        window.groma.layer.show = true;
        window.groma.viewer.scene.requestRender();
      });
      await ready();
      await clear();
    }
  });

  it.each(["globe", "map"] as const)(
    "by keyboard alone on the %s: draw, move a vertex, give up",
    async (which) => {
      await page.selectOption("#views", which);
      await page.evaluate(() => document.querySelector<HTMLElement>("#views")!.blur());
      await ready();
      // Places that the crosshair comes to from the middle, in steps of 10 pixels.
      const ways = await page.evaluate(async (on) => {
        const { beside, layer, viewer } = window.groma;
        const { map, measured } = (await beside.view)!;
        const element = on === "map" ? map.getViewport() : viewer.canvas;
        const signal = new AbortController().signal;
        const found: [number, number][] = [];
        const middle = on === "map" ? [0, 0] : [24, -5];
        const steps = [0, 4, 8, 12].flatMap((right) =>
          [0, 2].map((down) => [right + middle[0]!, down + middle[1]!] as const),
        );
        for (const [right, down] of steps) {
          if (found.length > 2) break;
          const at = { x: element.clientWidth / 2 + 10 * right, y: element.clientHeight / 2 + 10 * down };
          const hit =
            on === "map" ? await measured.pick(at, 7, signal) : await layer.pick(at, { window: 15 });
          if (hit) found.push([right, down]);
        }
        return found;
      }, which);
      expect(ways.length).toBe(3);
      const times = (key: string, count: number) => Array.from({ length: count }, () => key);
      let [across, below] = [0, 0];
      const go = (way: [number, number]) => {
        const [right, down] = [way[0] - across, way[1] - below];
        [across, below] = way;
        return press(
          ...times(right < 0 ? "ArrowLeft" : "ArrowRight", Math.abs(right)),
          ...times(down < 0 ? "ArrowUp" : "ArrowDown", Math.abs(down)),
          "Enter",
        );
      };
      await tool("Line").focus();
      await press("Enter");
      for (const [i, way] of ways.entries()) {
        await go(way);
        await drawn(i + 1);
      }
      await screenshot(page, `measuring-keyboard-${which}`);
      // Once more in the same place ends the line.
      await press("Enter");
      await measured(1);
      const [before] = await records();
      expect(new Set(before!.map(String)).size).toBe(3);

      await page.focus("button[aria-label='Edit Line 1']");
      await press("Enter");
      await page.focus(`#${which} circle[aria-label='Vertex 2 of Line 1']`);
      await press("ArrowUp");
      await moved(1, before![1]!);
      await press("Insert");
      await page.waitForFunction(() => window.groma.measure.measurements[0]!.vertices.length === 4);
      await press("Control+z", "Delete");
      expect((await records())[0]).toEqual([before![0], before![2]]);
      await press("Control+z", "Control+z");
      expect((await records())[0]).toEqual(before);
      await press("Escape");

      await tool("Area").focus();
      await press("Enter");
      [across, below] = [0, 0];
      await go(ways[0]!);
      await drawn(1);
      await press("Backspace");
      await drawn(0);
      await press("Escape");
      expect(await page.evaluate(() => window.groma.measure.drawing)).toBeUndefined();
      expect(await records()).toEqual([before]);
      await clear();
      await page.selectOption("#views", "both");
      await ready();
    },
    280_000,
  );

  it("by touch, begun on the globe and ended on the map, and volumes", { timeout: 280_000 }, async () => {
    const [[a], [b]] = [places.globe, places.map];
    await session.send("Emulation.setTouchEmulationEnabled", { enabled: true });
    await tool("Distance").click();
    await tap(a!);
    await drawn(1);
    await tap(b!);
    await entries().first().waitFor();
    expect(await records()).toEqual([[a!.integers, b!.integers]]);
    const labels = page.locator(".groma-label:visible");
    expect(await labels.count()).toBe(2);
    expect(await labels.nth(1).textContent()).toBe(await labels.nth(0).textContent());
    // Two taps at once would zoom the map; while a figure is drawn they end it.
    await tool("Line").click();
    const zoom = () => page.evaluate(async () => (await window.groma.beside.view)!.map.getView().getZoom());
    const before = await zoom();
    await tap(a!);
    await tap(b!);
    await tap(b!);
    await measured(2);
    await page.waitForTimeout(300);
    expect(await zoom()).toBe(before);
    await page.click("button[aria-label='Delete Line 1']");
    await tool("Undo").click();
    expect((await records())[1]).toEqual([a!.integers, b!.integers]);
    // A volume is read after it is drawn, and read anew when it is measured against something else.
    await tool("Volume").click();
    for (const [i, corner] of places.map.entries()) {
      await tap(corner);
      await drawn(i + 1);
    }
    await tap(places.map[0]!);
    const volume = entries().last();
    await volume.locator("dt:text-is('net')").waitFor();
    const net = () => volume.locator("dd").first().textContent();
    const lowest = await net();
    expect(lowest).toMatch(/m³/);
    await screenshot(page, "measuring-both");
    await volume.locator("select").selectOption("highest");
    await volume.locator("dt:text-is('net')").waitFor();
    await expect.poll(net, { timeout: 30_000 }).not.toBe(lowest);
    expect(await net()).toMatch(/^−/);
    await tool("Undo").click();
    await expect.poll(net, { timeout: 30_000 }).toBe(lowest);
    expect(await volume.locator("select").inputValue()).toBe("lowest");
    // Against a scan that is opened beside it, which here is the same one under another name: nothing has changed.
    const later = join(mkdtempSync(join(tmpdir(), "groma-")), "later.copc.laz");
    copyFileSync(converted(scan.path), later);
    await page.setInputFiles("#compare-file", later);
    await page.locator("#compare-note:has-text('later.copc.laz is open')").waitFor();
    await volume.locator("select").selectOption({ label: "the scan later.copc.laz" });
    await expect.poll(net, { timeout: 30_000 }).toMatch(/^0(\.0+)?\sm³/);
    await tool("Undo").click();
    await expect.poll(net, { timeout: 30_000 }).toBe(lowest);
    // A height above the ground, by the terrain: this scan has no classes.
    await tool("Above ground").click();
    await tap(places.map[1]!);
    const above = entries().last();
    await above.locator("dt:text-is('above the terrain')").waitFor();
    const height = await page.evaluate(() => window.groma.measure.measurements.at(-1)!.vertices[0]!.height);
    const told = (await above.locator("dd").first().textContent())!;
    expect(Number.parseFloat(told)).toBeCloseTo(height - TERRAIN, 1);
    await session.send("Emulation.setTouchEmulationEnabled", { enabled: false });
    await page.click("#measurements > li .name");
    await page.waitForFunction(
      async (was) => (await window.groma.beside.view)!.map.getView().getZoom() !== was,
      before,
    );
    expect([watch.errors, watch.foreign]).toEqual([[], []]);
  });

  it("is saved, and after a reload by a link stands on the same records on both", {
    timeout: 200_000,
  }, async () => {
    const download = page.waitForEvent("download");
    await page.click("#measure-save");
    const path = await (await download).path();
    const saved = JSON.parse(readFileSync(path, "utf8"));
    expect(saved.features.map(({ geometry }: { geometry: { type: string } }) => geometry.type)).toEqual([
      ...["LineString", "LineString", "Polygon", "Point"],
    ]);
    const before = await records();

    // A link brings back how the cloud is seen, and what is selected.
    const bare = await page.evaluate(async () => {
      const { layer, measure, viewer } = window.groma;
      measure.edit(undefined);
      for (let x = viewer.canvas.clientWidth - 10; x > 360; x -= 7) {
        for (const y of [150, 180, 210, 240]) {
          const free = document.elementFromPoint(x, y) === viewer.canvas;
          if (free && (await layer.pick({ x, y }, { window: 3 }))) return { x, y };
        }
      }
      return undefined;
    });
    await page.mouse.click(bare!.x, bare!.y);
    await page.locator("#picked").waitFor();
    const shown = () =>
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
      viewer.scene.requestRender();
    });
    await page.click("#copy-link");
    await page.locator("#link-note:has-text('link')").waitFor();
    expect(page.url()).toMatch(/#view=1~c[-\d._]+~s\w+~f\w+~k[\w-]+~p[\d-]+_\d+$/);
    const seen = await shown();

    await page.reload();
    await onDemand();
    await settle(page);
    await page.locator("#picked").waitFor();
    const again = await shown();
    expect([again.shown, again.picked]).toEqual([seen.shown, seen.picked]);
    for (const [i, value] of seen.camera.entries()) {
      expect(Math.abs(again.camera[i]! - value)).toBeLessThan(i < 3 ? 0.05 : 0.2);
    }
    await page.setInputFiles("#measure-file", path);
    await measured(before.length);
    expect(await records()).toEqual(before);
    expect(await page.locator("#globe .groma-label").count()).toBe(before.length);
    expect(await page.locator("#map .groma-label").count()).toBe(before.length);
    expect([watch.errors, watch.foreign]).toEqual([[], []]);
  });
});

import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { data } from "../project.js";
import { settle } from "./globe.js";
import { openPage, screenshot, sharedBrowser, type View, view } from "./harness.js";

const scan = data("autzen.laz");

describe.skipIf(scan.missing)(
  `a map beside the globe${scan.missing ? ` (skipped: ${scan.missing})` : ""}`,
  () => {
    let server: View;
    let browser: Browser;
    beforeAll(async () => {
      server = await view(converted(scan.path));
      browser = await sharedBrowser();
    }, 240_000);
    afterAll(async () => {
      await browser?.close();
      await server?.stop();
    });

    it("is loaded anew when it is shown again, where its code could not be had", {
      timeout: 60_000,
    }, async () => {
      const { page } = await openPage(browser, { width: 800, height: 600 });
      const code = "**/map-view*.js";
      await page.route(code, (route) => route.abort());
      await page.goto(`${server.address}&map=1&fly=0&budget=1000`);
      await page.locator("#message .code").waitFor({ timeout: 20_000 });
      await page.unroute(code);
      for (const shown of ["globe", "both"]) await page.locator("#views").selectOption(shown);
      await page.locator("#map .ol-viewport").waitFor({ timeout: 10_000 });
      await page.close();
    });

    it("shows the same cloud in the same style, and reads no byte twice", { timeout: 240_000 }, async () => {
      const { page, watch } = await openPage(browser, { width: 1200, height: 600 });
      const ranges: string[] = [];
      page.on("request", (request) => {
        const range = request.headers().range;
        if (range) ranges.push(range);
      });
      await page.goto(`${server.address}&map=1&fly=0&budget=300000`);
      await settle(page);
      const complete = () =>
        page.evaluate(async () => {
          const { map } = (await window.groma.beside.view)!;
          await new Promise<void>((resolve) => {
            map.once("rendercomplete", () => resolve());
            map.render();
          });
        });
      await complete();
      await screenshot(page, "beside");
      // The box of the cloud is in the middle of what the panel leaves of the globe, seen obliquely.
      const box = await page.evaluate(() => {
        const { layer, viewer } = window.groma;
        const { min, max } = layer.cloud.boundingBox;
        const pixels = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => {
          const [x, y, z] = [0, 1, 2].map((axis) => ((corner >> axis) & 1 ? max : min)[axis]!);
          const [px, py, pz] = layer.cloud.place(x!, y!, z!);
          const place = Object.assign(viewer.camera.positionWC.clone(), { x: px, y: py, z: pz });
          return viewer.scene.cartesianToCanvasCoordinates(place)!;
        });
        const [xs, ys] = [pixels.map(({ x }) => x), pixels.map(({ y }) => y)];
        const { right } = document.getElementById("panel")!.getBoundingClientRect();
        const { clientWidth, clientHeight } = viewer.canvas;
        return {
          left: Math.min(...xs) - right,
          right: clientWidth - Math.max(...xs),
          top: Math.min(...ys),
          bottom: clientHeight - Math.max(...ys),
        };
      });
      expect(Math.abs(box.left - box.right)).toBeLessThan(1);
      // The lower margin is 16 pixels wider, for the credits.
      expect(Math.abs(box.bottom - 16 - box.top)).toBeLessThan(1);
      const lit = () =>
        page.evaluate(() => {
          const canvas = document.querySelector<HTMLCanvasElement>("#map .ol-layer canvas")!;
          const copy = new OffscreenCanvas(canvas.width, canvas.height);
          const context = copy.getContext("2d")!;
          context.drawImage(canvas, 0, 0);
          const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
          let [count, red] = [0, 0];
          for (let at = 0; at < data.length; at += 4) {
            if (data[at + 3]! > 0) count++;
            if (data[at]! > 200 && data[at + 1]! < 60 && data[at + 2]! < 60) red++;
          }
          return { count, red };
        });
      const shown = await lit();
      expect(shown.count).toBeGreaterThan(20_000);
      expect(shown.red).toBeLessThan(100);
      const spans = ranges.map((range) => /^bytes=(\d+)-(\d+)$/.exec(range)!.slice(1).map(Number));
      spans.sort(([a], [b]) => a! - b!);
      expect(spans.length).toBeGreaterThan(1);
      expect(spans.filter(([from], at) => at > 0 && from! <= spans[at - 1]![1]!)).toEqual([]);
      // What is chosen for the globe holds for the map.
      await page.evaluate(() => {
        const { layer, viewer } = window.groma;
        layer.style = {
          color: "elevation",
          gradient: [
            { at: 0, color: [1, 0, 0] },
            { at: 1, color: [1, 0, 0] },
          ],
        };
        viewer.scene.requestRender();
      });
      await settle(page);
      await complete();
      const recoloured = await lit();
      expect(recoloured.red).toBeGreaterThan(0.9 * recoloured.count);
      // The map shows what the globe does, and follows it and leads it.
      const middles = () =>
        page.evaluate(async () => {
          const { beside, layer, viewer } = window.groma;
          const { map, measured } = (await beside.view)!;
          // Let what rests be read, and the frames after it be drawn, until neither moves the other any more.
          const pose = () => `${map.getView().getCenter()} ${viewer.camera.positionWC}`;
          for (let last = "", resting = 0; resting < 4; last = pose()) {
            await new Promise((done) => setTimeout(done, 500));
            resting = pose() === last && layer.settled ? resting + 1 : 0;
          }
          // The panel lies over the left part of the globe.
          const { right } = document.getElementById("panel")!.getBoundingClientRect();
          const at = { x: (right + viewer.canvas.clientWidth) / 2, y: viewer.canvas.clientHeight / 2 };
          const hit = (await layer.pick(at as Parameters<typeof layer.pick>[0], { window: 9 }))!;
          const place = viewer.scene.globe.ellipsoid.cartesianToCartographic(hit.position)!;
          const pixel = measured.project(place as unknown as Parameters<typeof measured.project>[0])!;
          const [width, height] = map.getSize()!;
          const [x, y] = map.getView().getCenter()!;
          const off = Math.hypot(pixel.x - width! / 2, pixel.y - height! / 2);
          return { x: x!, y: y!, off, height: viewer.camera.positionCartographic.height };
        });
      const before = await middles();
      // The window of the pick and the page's margins, in pixels that are foreshortened.
      expect(before.off).toBeLessThan(25);
      await page.evaluate(() => window.groma.viewer.camera.moveForward(300));
      const nearer = await middles();
      expect(nearer.height).toBeLessThan(before.height);
      expect(nearer.off).toBeLessThan(25);
      await page.evaluate(async () => {
        const view = (await window.groma.beside.view)!.map.getView();
        view.setCenter(view.getCenter()!.map((at) => at + 100));
      });
      const moved = await middles();
      expect(moved.off).toBeLessThan(25);
      expect([moved.x - nearer.x, moved.y - nearer.y]).toEqual([
        expect.closeTo(100, 3),
        expect.closeTo(100, 3),
      ]);
      await screenshot(page, "beside-linked");
      await page.selectOption("#views", "map");
      const frames = await page.evaluateHandle(() => {
        const frames = { globe: 0 };
        window.groma.viewer.scene.postRender.addEventListener(() => frames.globe++);
        return frames;
      });
      expect(await page.isVisible("#split")).toBe(false);
      const width = await page.evaluate(() => document.getElementById("map")!.getBoundingClientRect().width);
      expect(width).toBe(1200);
      await complete();
      await screenshot(page, "map-alone");
      // The panel and the link to the page go by the map, and nothing of the globe shows.
      expect(await page.isVisible("#globe")).toBe(false);
      await page.waitForFunction(
        () => {
          const { pointsDrawn = -1 } = window.groma.beside.statistics ?? {};
          return document.getElementById("count")!.textContent!.includes(pointsDrawn.toLocaleString("en"));
        },
        undefined,
        { timeout: 120_000 },
      );
      // What is chosen for the globe holds for the map still.
      await page.evaluate(() => {
        window.groma.layer.style = { color: "intensity", gradient: "auto" };
      });
      await page.waitForFunction(
        async () => {
          const { map } = (await window.groma.beside.view)!;
          const [layer] = map.getAllLayers().filter((one) => "style" in one) as never as [
            { style: { color: unknown } },
          ];
          return `${layer.style.color}` === "intensity";
        },
        undefined,
        { timeout: 60_000 },
      );
      await complete();
      expect((await lit()).red).toBeLessThan(recoloured.red / 10);
      const there = await page.evaluate(() => window.groma.viewer.camera.positionWC.x);
      await page.evaluate(async () => {
        (await window.groma.beside.view)!.map.getView().adjustCenter([30_000, 0]);
      });
      await page.waitForFunction(
        () => document.getElementById("stage")!.textContent === "No points in this view.",
        undefined,
        { timeout: 120_000 },
      );
      await page.waitForFunction((x) => Math.abs(window.groma.viewer.camera.positionWC.x - x) > 1000, there, {
        timeout: 120_000,
      });
      // And where the globe is sent, the map goes.
      await page.evaluate(async () => {
        const { viewer } = window.groma;
        const view = (await window.groma.beside.view)!.map.getView();
        Object.assign(window, { before: `${view.getCenter()}` });
        viewer.camera.moveRight(-20_000);
      });
      await page.waitForFunction(
        async () => {
          const view = (await window.groma.beside.view)!.map.getView();
          return `${view.getCenter()}` !== (window as never as { before: string }).before;
        },
        undefined,
        { timeout: 60_000 },
      );
      // All of that without a frame of the globe, which goes on when it is shown again.
      expect(await frames.evaluate(({ globe }) => globe)).toBe(0);
      await page.locator("#copy-link").evaluate((button: HTMLButtonElement) => button.click());
      expect(new URL(page.url()).searchParams.get("map")).toBe("only");
      await page.evaluate(async () => {
        (await window.groma.beside.view)!.map.getView().adjustCenter([-30_000, 0]);
      });
      await page.selectOption("#views", "globe");
      expect(await page.isVisible("#map")).toBe(false);
      await page.waitForFunction((frames) => (frames as { globe: number }).globe > 2, frames, {
        timeout: 60_000,
      });
      expect(watch.errors).toEqual([]);
      expect(watch.foreign).toEqual([]);
      await page.context().close();
    });

    it("shows all of the cloud alone, without a frame of the globe from the start", {
      timeout: 240_000,
    }, async () => {
      const { page, watch } = await openPage(browser, { width: 800, height: 500 });
      await page.goto(`${server.address}&map=only&fly=0&budget=50000`);
      await page.waitForFunction(
        () => document.getElementById("stage")?.textContent === "This view is complete.",
        undefined,
        { timeout: 120_000 },
      );
      const seen = await page.evaluate(async () => {
        const { viewer, beside, layer } = window.groma;
        const { frameState } = viewer.scene as unknown as { frameState: { frameNumber: number } };
        const { map } = (await beside.view)!;
        const [minX, minY, maxX, maxY] = map.getView().calculateExtent() as [number, number, number, number];
        const { min, max } = layer.cloud.boundingBox;
        const [x, y, z] = layer.cloud.place(
          ...([0, 1, 2].map((axis) => (min[axis]! + max[axis]!) / 2) as [number, number, number]),
        );
        const middle = viewer.scene.globe.ellipsoid.cartesianToCartographic({ x, y, z } as never)!;
        const at = [middle.longitude * 6378137, Math.asinh(Math.tan(middle.latitude)) * 6378137];
        return {
          frames: frameState.frameNumber,
          drawn: beside.statistics!.pointsDrawn,
          within: at[0]! > minX && at[0]! < maxX && at[1]! > minY && at[1]! < maxY,
          width: maxX - minX,
          pixel: map.getPixelFromCoordinate(at)[0]!,
          covered: document.getElementById("panel")!.getBoundingClientRect().right,
        };
      });
      await screenshot(page, "map-alone-from-the-start");
      expect(seen.frames).toBeLessThanOrEqual(1);
      expect(seen.drawn).toBeGreaterThan(10_000);
      expect(seen.within).toBe(true);
      // Autzen is 1.1 km wide, 1.5 km in Mercator's plane.
      // And it lies in the middle of what the panel leaves of the map.
      expect(Math.abs(seen.pixel - (seen.covered + 800) / 2)).toBeLessThan(10);
      expect(seen.width).toBeGreaterThan(1500);
      expect(seen.width).toBeLessThan(10_000);
      expect(watch.errors).toEqual([]);
      await page.context().close();
    });

    it("stands below the globe on a phone", { timeout: 240_000 }, async () => {
      const { page } = await openPage(browser, { width: 400, height: 700 });
      await page.goto(`${server.address}&map=1&fly=0&budget=50000`);
      await settle(page);
      const [globe, map] = await page.evaluate(() =>
        ["globe", "map"].map((id) => document.getElementById(id)!.getBoundingClientRect().toJSON()),
      );
      expect([globe.width, map.width]).toEqual([400, 400]);
      expect([globe.bottom, map.top, map.bottom]).toEqual([350, 350, 700]);
      await page.focus("#split");
      await page.keyboard.press("ArrowUp");
      const top = await page.evaluate(() => document.getElementById("map")!.getBoundingClientRect().top);
      expect(top).toBeCloseTo(0.45 * 700, 3);
      const bar = await page.evaluate(() =>
        document.getElementById("split")!.getBoundingClientRect().toJSON(),
      );
      await page.mouse.move(bar.x + bar.width / 2, bar.y + bar.height / 2);
      await page.mouse.down();
      await page.mouse.move(200, 420, { steps: 3 });
      await page.mouse.up();
      const dragged = await page.evaluate(() => document.getElementById("map")!.getBoundingClientRect().top);
      expect(dragged).toBeCloseTo(420, 0);
      // The base map that comes with the page lies below the points, on all of the map.
      const bare = await page.evaluate(async () => {
        const { map } = (await window.groma.beside.view)!;
        await new Promise<void>((resolve) => {
          map.once("rendercomplete", () => resolve());
          map.render();
        });
        const { width, height } = document.querySelector<HTMLCanvasElement>("#map .base canvas")!;
        const context = new OffscreenCanvas(width, height).getContext("2d")!;
        context.drawImage(document.querySelector<HTMLCanvasElement>("#map .base canvas")!, 0, 0);
        const { data } = context.getImageData(0, 0, width, height);
        return data.filter((value, at) => at % 4 === 3 && value === 0).length / (width * height);
      });
      expect(bare).toBe(0);
      await page.context().close();
    });
  },
);

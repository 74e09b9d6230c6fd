import { expect, it } from "vitest";
import { screenshot } from "../harness.js";
import type { MeasuringStage } from "./stage.js";

/** Drawing and editing without a pointer. */
export function testsByKeyboard(stage: () => MeasuringStage): void {
  it.each(["globe", "map"] as const)(
    "by keyboard alone on the %s: draw, move a vertex, give up",
    async (which) => {
      const { page, ready, records, tool, drawn, measured, moved, press, clear } = stage();
      // A map alone goes where the globe goes: the places that other tests know of it are those of its view before.
      const seenBefore = await page.evaluate(async () => {
        const view = (await window.groma.beside.view)!.map.getView();
        return [view.getCenter()!, view.getResolution()!, view.getRotation()] as const;
      });
      await page.selectOption("#views", which);
      await page.evaluate(() => document.querySelector<HTMLElement>("#views")!.blur());
      await ready(which === "map");
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
      // A line needs two, and says so.
      await press("Delete");
      await page.waitForSelector("#message .code:text('MEASURE_VERTICES')");
      expect((await records())[0]).toEqual([before![0], before![2]]);
      await page.evaluate(() => document.querySelector("#message")!.replaceChildren());
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
      await page.evaluate(async ([center, resolution, rotation]) => {
        const view = (await window.groma.beside.view)!.map.getView();
        view.setRotation(rotation);
        view.setResolution(resolution);
        view.setCenter(center);
      }, seenBefore);
      await ready();
    },
    280_000,
  );
}

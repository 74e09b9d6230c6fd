import { expect, it } from "vitest";
import { screenshot } from "../harness.js";
import type { MeasuringStage } from "./stage.js";

/** Drawing, editing and undoing by mouse. */
export function testsByMouse(stage: () => MeasuringStage): void {
  it("by mouse: draw, in units and worth, drag a vertex on either view, undo", {
    timeout: 280_000,
  }, async () => {
    const { page, places, records, entries, tool, drawn, moved, press, clear } = stage();
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
}

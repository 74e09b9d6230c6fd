import { expect, it } from "vitest";
import type { MeasuringStage } from "./stage.js";

/** What a click near vertices and edges takes. */
export function testsOfSnapping(stage: () => MeasuringStage): void {
  it("snaps to vertices before points, and to edges where there is none, on both", {
    timeout: 280_000,
  }, async () => {
    const { page, places, ready, records, tool, drawn, measured, clear, line } = stage();
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
}

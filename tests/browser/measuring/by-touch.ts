import { copyFileSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { expect, it } from "vitest";
import { converted } from "../../converted.js";
import { data } from "../../project.js";
import { screenshot } from "../harness.js";
import { type MeasuringStage, TERRAIN } from "./stage.js";

/** Drawing by touch across both views, volumes and heights. */
export function testsByTouch(stage: () => MeasuringStage): void {
  it("by touch, begun on the globe and ended on the map, and volumes", { timeout: 280_000 }, async () => {
    const { page, watch, session, places, records, entries, tool, drawn, measured, tap } = stage();
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
    await expect.poll(net).not.toBe(lowest);
    expect(await net()).toMatch(/^−/);
    await tool("Undo").click();
    await expect.poll(net).toBe(lowest);
    expect(await volume.locator("select").inputValue()).toBe("lowest");
    // Against a scan that is opened beside it, which here is the same one under another name: nothing has changed.
    const later = join(mkdtempSync(join(tmpdir(), "groma-")), "later.copc.laz");
    copyFileSync(converted(data("vol_total.laz").path), later);
    await page.setInputFiles("#compare-file", later);
    await page.locator("#compare-note:has-text('later.copc.laz is open')").waitFor();
    await volume.locator("select").selectOption({ label: "the scan later.copc.laz" });
    await expect.poll(net).toMatch(/^0(\.0+)?\sm³/);
    await tool("Undo").click();
    await expect.poll(net).toBe(lowest);
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
}

import { readFileSync } from "node:fs";
import { expect, it } from "vitest";
import { settle } from "../globe.js";
import type { MeasuringStage } from "./stage.js";

/** Files of measurements and links to what is seen. */
export function testsOfSaving(stage: () => MeasuringStage): void {
  it("is saved, and after a reload by a link stands on the same records on both", {
    timeout: 200_000,
  }, async () => {
    const { page, watch, records, measured } = stage();
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
    await settle(page);
    await page.locator("#picked").waitFor();
    const again = await shown();
    expect([again.shown, again.picked]).toEqual([seen.shown, seen.picked]);
    for (const [i, value] of seen.camera.entries()) {
      expect(Math.abs(again.camera[i]! - value)).toBeLessThan(i < 3 ? 0.05 : 0.2);
    }
    // The address names that view until the camera leaves it.
    expect(page.url()).toContain("#view=");
    await page.evaluate(() => {
      window.groma.viewer.camera.moveForward(20);
      window.groma.viewer.scene.requestRender();
    });
    await page.waitForURL(({ hash }) => hash === "");
    await page.setInputFiles("#measure-file", path);
    await measured(before.length);
    expect(await records()).toEqual(before);
    expect(await page.locator("#globe .groma-label").count()).toBe(before.length);
    expect(await page.locator("#map .groma-label").count()).toBe(before.length);
    expect([watch.errors, watch.foreign]).toEqual([[], []]);
  });
}

import { expect, it } from "vitest";
import { from, metres, type NavigationStage, to } from "./stage.js";

/** What navigation leaves to others. */
export function testsOfLeaving(stage: () => NavigationStage): void {
  it("leaves the camera to tools, flights, and Cesium's own navigation", { timeout: 60_000 }, async () => {
    const { page, stand, drag } = stage();
    const before = await stand();
    const allow = (enableInputs: boolean) =>
      page.evaluate((inputs) => {
        window.page.stage.scene.screenSpaceCameraController.enableInputs = inputs;
      }, enableInputs);
    await allow(false);
    await drag(from, to);
    expect((await stand()).position).toEqual(before.position);
    await allow(true);
    const flags = () =>
      page.evaluate(() => {
        const { enableRotate, enableZoom, enableTilt, enableLook } =
          window.page.stage.scene.screenSpaceCameraController;
        return [enableRotate, enableZoom, enableTilt, enableLook];
      });
    expect(await flags()).toEqual([false, false, false, false]);
    await page.evaluate(() => {
      window.page.navigation.enabled = false;
    });
    expect(await flags()).toEqual([true, true, true, true]);
    const arrived = await page.evaluate(async () => {
      const { navigation, stage } = window.page;
      navigation.enabled = true;
      const { center } = stage.layer.boundingSphere;
      const all = [
        navigation.flyTo(center, { distance: 400, duration: 0.3 }),
        navigation.flyTo(center, { distance: 500, duration: 0.3 }),
      ];
      return Promise.all(all);
    });
    // The second one has ended the first.
    expect(arrived).toEqual([false, true]);
    const { center } = await page.evaluate(() => {
      const { x, y, z } = window.page.stage.layer.boundingSphere.center;
      return { center: { x, y, z } };
    });
    expect(metres(center, await stand())).toBeCloseTo(500, 2);
    const refused = await page.evaluate(async () => {
      const { navigation } = window.page;
      const codes: unknown[] = [];
      for (const wrong of [
        () => Object.assign(navigation, { mode: "fly" }),
        () => Object.assign(navigation, { collision: -1 }),
        () => navigation.flyTo({ x: 1 } as never),
        () => new window.page.PointNavigation({} as never),
        () => new window.page.PointNavigation(window.page.stage.widget, { colision: 1 } as never),
      ]) {
        try {
          wrong();
          codes.push("nothing");
        } catch (thrown) {
          codes.push((thrown as { code: string }).code);
        }
      }
      return codes;
    });
    expect(refused).toEqual(Array(5).fill("STYLE_OPTION"));
    // At last, it goes without a trace.
    await page.evaluate(() => {
      const { navigation } = window.page;
      navigation.enabled = true;
      navigation.destroy();
      navigation.destroy();
    });
    expect(await flags()).toEqual([true, true, true, true]);
    expect(await page.evaluate(() => window.page.navigation.isDestroyed())).toBe(true);
  });
}

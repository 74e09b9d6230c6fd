import { expect, it } from "vitest";
import { screenshot } from "../harness.js";
import { from, metres, type NavigationStage } from "./stage.js";

/** Walking and moving by keys. */
export function testsByKeyboard(stage: () => NavigationStage): void {
  it("looks around from where it stands, and walks", { timeout: 60_000 }, async () => {
    const { page, stand, rest, drag } = stage();
    const before = await stand();
    await page.keyboard.down("Shift");
    await drag(from, { x: 255, y: 165 });
    await page.keyboard.up("Shift");
    const looked = await stand();
    expect(looked.position).toEqual(before.position);
    // 40 pixels of the 60° that the picture is wide, at its middle.
    expect(before.heading - looked.heading).toBeGreaterThan(0.09);
    expect(looked.pitch).toBeCloseTo(before.pitch, 4);

    await page.focus("canvas");
    await page.keyboard.press("f");
    expect(await page.evaluate(() => window.page.navigation.mode)).toBe("walk");
    await page.keyboard.down("w");
    await page.waitForFunction((from) => {
      const { x, y, z } = window.page.stage.scene.camera.positionWC;
      return Math.hypot(x - from[0]!, y - from[1]!, z - from[2]!) > 30;
    }, before.position);
    await page.keyboard.up("w");
    await rest();
    const walked = await stand();
    expect(walked.height).toBeCloseTo(before.height, 2);
    expect(walked.pitch).toBeCloseTo(looked.pitch, 3);
    const [x, y, z] = walked.position;
    expect(metres({ x, y, z }, before)).toBeGreaterThan(30);
    await drag(from, { x: 255, y: 195 });
    expect((await stand()).position).toEqual(walked.position);
  });

  it("is moved by the keyboard alone", { timeout: 90_000 }, async () => {
    const { page, stand, rest, farthest } = stage();
    const press = async (...keys: string[]) => {
      for (const key of keys) await page.keyboard.press(key);
      await rest();
      return stand();
    };
    await page.focus("canvas");
    const before = await stand();
    const ahead = await press("ArrowUp");
    const [x, y, z] = ahead.position;
    expect(metres({ x, y, z }, before)).toBeGreaterThan(10);
    expect(ahead.height).toBeCloseTo(before.height, 2);
    const near = await press("+", "+");
    expect(near.height).toBeLessThan(ahead.height - 20);
    const turned = await press("Shift+ArrowLeft", "Shift+ArrowUp");
    expect(Math.abs(turned.heading - near.heading)).toBeGreaterThan(0.05);
    expect(turned.pitch).toBeGreaterThan(near.pitch + 0.03);
    const north = await press("n");
    expect(Math.abs(Math.sin(north.heading))).toBeLessThan(1e-3);
    const down = await press("u");
    expect(down.pitch).toBeCloseTo(-Math.PI / 2, 3);
    expect(await farthest()).toBeLessThan(800);
    await screenshot(page, "navigation-down");
  });

  it("keeps away from points where it is told to", { timeout: 90_000 }, async () => {
    const { page, look, stand, rest } = stage();
    const walk = async (clearance: number) => {
      await look(-10, 200);
      await page.evaluate((metres) => {
        const { navigation, stage } = window.page;
        navigation.collision = metres;
        stage.scene.screenSpaceCameraController.enableCollisionDetection = false;
      }, clearance);
      await page.focus("canvas");
      await page.keyboard.down("Shift");
      await page.keyboard.down("q");
      // At some 500 m a second; of a slow frame a tenth of a second counts.
      await page.waitForTimeout(1200);
      await page.waitForFunction(() => {
        const { moves } = window as unknown as { moves: number[] };
        return window.page.stage.scene.camera.positionCartographic.height < 0 || moves.length > 15;
      });
      await page.keyboard.up("q");
      await page.keyboard.up("Shift");
      await rest();
      const { position, height } = await stand();
      const nearest = await page.evaluate((at) => {
        const { layer } = window.page.stage as unknown as {
          layer: { drawnNear(place: readonly number[], radius: number): readonly number[] };
        };
        const points = layer.drawnNear(at, 100);
        let least = Number.POSITIVE_INFINITY;
        for (let i = 0; i < points.length; i += 3) {
          least = Math.min(
            least,
            Math.hypot(points[i]! - at[0], points[i + 1]! - at[1], points[i + 2]! - at[2]),
          );
        }
        return least;
      }, position);
      return { height, nearest };
    };
    const through = await walk(0);
    const kept = await walk(15);
    expect(kept.nearest).toBeGreaterThan(14.9);
    expect(kept.nearest).toBeLessThan(25);
    expect(kept.height).toBeGreaterThan(through.height + 15);
  });
}

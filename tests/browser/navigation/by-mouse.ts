import type { Cartesian3 } from "cesium";
import { expect, it } from "vitest";
import { screenshot } from "../harness.js";
import { away, from, metres, type NavigationStage, to } from "./stage.js";

/** Dragging, orbiting, zooming and looking by the mouse. */
export function testsByMouse(stage: () => NavigationStage): void {
  it("drags the picked point along, at one height", { timeout: 60_000 }, async () => {
    const { page, stand, pick, pixelOf, drag } = stage();
    const [place, before] = [await pick(from), await stand()];
    await drag(from, to);
    const after = await stand();
    expect(away(await pixelOf(place), to)).toBeLessThan(0.5);
    expect(after.height).toBeCloseTo(before.height, 2);
    expect(after.pitch).toBeCloseTo(before.pitch, 4);
    expect(
      metres({ x: before.position[0], y: before.position[1], z: before.position[2] }, after),
    ).toBeGreaterThan(20);
    await screenshot(page, "navigation-dragged");
  });

  it("orbits about the picked point, and approaches it", { timeout: 60_000 }, async () => {
    const { page, look, stand, pick, pixelOf, rest, drag } = stage();
    const [place, before] = [await pick(from), await stand()];
    await drag(from, { x: 125, y: 125 }, "right");
    const orbited = await stand();
    expect(away(await pixelOf(place), from)).toBeLessThan(0.5);
    expect(metres(place, orbited)).toBeCloseTo(metres(place, before), 3);
    // 90 pixels of 300 are 54°, to the left: the camera goes round to the right.
    expect(Math.abs(Math.sin(orbited.heading - before.heading))).toBeCloseTo(
      Math.sin((54 * Math.PI) / 180),
      2,
    );
    expect(orbited.pitch - before.pitch).toBeCloseTo((40 / 300) * Math.PI, 2);

    await look();
    await page.mouse.move(from.x, from.y);
    for (let turns = 0; turns < 5; turns++) await page.mouse.wheel(0, -120);
    await rest();
    const near = await stand();
    expect(away(await pixelOf(place), from)).toBeLessThan(0.5);
    expect(metres(place, near) / metres(place, before)).toBeCloseTo(Math.exp(-600 / 400), 2);
  });

  it("flies to the point of a double click", { timeout: 60_000 }, async () => {
    const { page, stand, pick, pixelOf, rest } = stage();
    const [place, before] = [await pick(from), await stand()];
    await page.mouse.dblclick(from.x, from.y);
    await page.waitForFunction(
      ([at, metres]) => {
        const { Cesium, stage } = window.page;
        return Cesium.Cartesian3.distance(stage.scene.camera.positionWC, at as Cartesian3) < metres;
      },
      [place, 0.34 * metres(place, before)] as const,
    );
    await rest();
    const after = await stand();
    expect(away(await pixelOf(place), { x: 200, y: 150 })).toBeLessThan(1);
    expect(metres(place, after) / metres(place, before)).toBeCloseTo(1 / 3, 2);
    expect(after.heading).toBeCloseTo(before.heading, 2);
  });

  it("goes on where there is no point, into the sky and beside the scan", { timeout: 60_000 }, async () => {
    const { page, look, stand, rest, farthest, drag } = stage();
    await look(-4, 700);
    // Above the horizon: what is as far as what was found last.
    await drag({ x: 200, y: 20 }, { x: 230, y: 40 });
    await drag({ x: 20, y: 200 }, { x: 120, y: 190 }, "right");
    await page.mouse.wheel(0, -120);
    await rest();
    const { position } = await stand();
    expect(position.every(Number.isFinite)).toBe(true);
    // All of a drag may be in one frame here: a third of half a turn at 700 m.
    expect(await farthest()).toBeLessThan(800);
  });

  it("looks from under the scan, where it may", { timeout: 60_000 }, async () => {
    const { page, look, stand, pick, pixelOf, drag } = stage();
    const place = await pick(from);
    const rise = { x: from.x, y: from.y - 130 };
    await drag(from, rise, "right");
    const below = await stand();
    expect(below.pitch).toBeGreaterThan(0.5);
    expect(away(await pixelOf(place), from)).toBeLessThan(0.5);
    await screenshot(page, "navigation-under");
    await look();
    await page.evaluate(() => {
      window.page.navigation.lookUnder = false;
    });
    await drag(from, rise, "right");
    expect((await stand()).pitch).toBeLessThan(0.01);
  });
}

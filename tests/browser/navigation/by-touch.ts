import { expect, it } from "vitest";
import { away, from, metres, type NavigationStage, type Spot, to } from "./stage.js";

/** Moving by fingers. */
export function testsByTouch(stage: () => NavigationStage): void {
  it("is moved by one, two and three fingers", { timeout: 90_000 }, async () => {
    const { look, stand, pick, pixelOf, rest, touch } = stage();
    /** Takes fingers from some places to others. */
    const fingers = async (...ways: readonly (readonly [Spot, Spot])[]) => {
      const at = (share: number) =>
        ways.map(([a, b], id) => ({ id, x: a.x + share * (b.x - a.x), y: a.y + share * (b.y - a.y) }));
      const send = (
        type: "touchStart" | "touchMove" | "touchEnd",
        touchPoints: { id: number; x: number; y: number }[],
      ) => touch.send("Input.dispatchTouchEvent", { type, touchPoints });
      await send("touchStart", at(0));
      for (const share of [0.3, 0.6, 1]) await send("touchMove", at(share));
      await send("touchEnd", []);
      await rest();
    };
    const place = await pick(from);
    await fingers([from, to]);
    expect(away(await pixelOf(place), to)).toBeLessThan(0.5);

    await look();
    const before = await stand();
    const middle = await pick({ x: 200, y: 150 });
    // A pinch that doubles, moves and turns by a right angle.
    await fingers(
      [
        { x: 170, y: 150 },
        { x: 220, y: 110 },
      ],
      [
        { x: 230, y: 150 },
        { x: 220, y: 230 },
      ],
    );
    const pinched = await stand();
    expect(away(await pixelOf(middle), { x: 220, y: 170 })).toBeLessThan(0.5);
    // Half as far, and a little nearer by being dragged towards the camera.
    expect(metres(middle, pinched) / metres(middle, before)).toBeGreaterThan(0.43);
    expect(metres(middle, pinched) / metres(middle, before)).toBeLessThan(0.5);
    expect(Math.abs(Math.sin(pinched.heading - before.heading))).toBeCloseTo(1, 2);

    await look();
    const spots = [150, 200, 250].map(
      (x) =>
        [
          { x, y: 150 },
          { x: x - 60, y: 130 },
        ] as const,
    );
    await fingers(...spots);
    const orbited = await stand();
    expect(Math.abs(Math.sin(orbited.heading - before.heading))).toBeCloseTo(
      Math.sin((60 / 300) * Math.PI),
      2,
    );
    expect(away(await pixelOf(middle), { x: 200, y: 150 })).toBeLessThan(0.5);
  });
}

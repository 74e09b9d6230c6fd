import { expect, it } from "vitest";
import { StillFrame } from "./still-frame.js";

it("stands while nothing is another but for the rounding of numbers, however often they are rounded", () => {
  const still = new StillFrame();
  const style = {};
  const ground = (...numbers: readonly number[]) => [style, undefined, ...numbers];
  const place = [0.6, 6_378_137, Number.POSITIVE_INFINITY];
  still.note(ground(...place));
  expect(still.holds(ground(0.6 + 2e-16, 6_378_137.000000002, Number.POSITIVE_INFINITY))).toBe(true);
  expect(still.holds(ground(0.6 + 2e-12, 6_378_137, Number.POSITIVE_INFINITY))).toBe(false);
  expect(still.holds(ground(0.6, 6_378_137.0001, Number.POSITIVE_INFINITY))).toBe(false);
  expect(still.holds(ground(0.6, 6_378_137, 1))).toBe(false);
  expect(still.holds([{}, undefined, ...place])).toBe(false);
  // Each is held against the frame that was drawn, so that many small turns come to a frame.
  let turns = 0;
  for (let x = 0.6; still.holds(ground(x, 6_378_137, Number.POSITIVE_INFINITY)); x += 1e-13) turns++;
  expect(turns).toBeLessThan(12);
});

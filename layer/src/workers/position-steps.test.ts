import fc from "fast-check";
import { expect, it } from "vitest";
import { reachOf, stepBound, stepOver, toSteps } from "./position-steps.js";

const reach = fc.double({ min: 1e-4, max: 1e7, noNaN: true });
const share = fc.double({ min: -1, max: 1, noNaN: true });

it("moves places by no more than is stated, to steps that 20 bits and a sign count", () => {
  fc.assert(
    fc.property(reach, fc.array(fc.tuple(share, share, share), { minLength: 1 }), (metres, shares) => {
      const exact = Float32Array.from(shares.flat(), (part) => part * metres);
      const step = stepOver(reachOf(exact));
      const moved = exact.slice();
      toSteps(moved, step);
      for (let at = 0; at < exact.length; at += 3) {
        const away = [0, 1, 2].map((axis) => moved[at + axis]! - exact[at + axis]!);
        expect(Math.hypot(...away)).toBeLessThanOrEqual(stepBound(step));
      }
      for (const value of moved) {
        expect(Number.isInteger(value / step)).toBe(true);
        expect(Math.abs(value / step)).toBeLessThan(2 ** 20);
      }
      // No step twice as fine would do.
      expect(step === 2 ** -30 || reachOf(exact) > (2 ** 20 - 1) * (step / 2)).toBe(true);
    }),
  );
});

it("has a step for a node of one point", () => {
  expect(stepOver(0)).toBe(2 ** -30);
});

import { describe, expect, it } from "vitest";
import { NODES } from "../approximation/chebyshev.js";
import type { Link } from "../transformation/link.js";
import type { Box } from "./expansion.js";
import { BOTTOM, MIDDLE, NodeSamples, TOP } from "./node-samples.js";

const box: Box = { x: 100, y: -200, z: 30, halfX: 10, halfY: 20, halfZ: 5 };

const link = (apply: (state: Float64Array) => void): Link => ({ apply, differentiate: () => undefined });

/** The state of a sample. */
function read(samples: NodeSamples, i: number, j: number, height: number): number[] {
  const out = new Float64Array(3);
  samples.read(samples.snapshot(), i, j, height, out);
  return [...out];
}

describe("samples of a node", () => {
  it("stand at the Chebyshev nodes of its plan, at the bottom, in the middle and at the top", () => {
    const samples = new NodeSamples(box);
    const middle = (NODES - 1) / 2;
    expect(read(samples, middle, middle, MIDDLE)).toEqual([
      expect.closeTo(100, 12),
      expect.closeTo(-200, 12),
      30,
    ]);
    for (let i = 0; i < NODES; i++) {
      for (let j = 0; j < NODES; j++) {
        const [x, y] = [i, j].map((k) => Math.cos(((2 * k + 1) * Math.PI) / (2 * NODES)));
        for (const [height, z] of [
          [BOTTOM, 25],
          [MIDDLE, 30],
          [TOP, 35],
        ]) {
          const [sx, sy, sz] = read(samples, i, j, height);
          expect([Math.abs((sx - 100) / 10), Math.abs((sy + 200) / 20), sz]).toEqual([
            ...[expect.closeTo(Math.abs(x), 12), expect.closeTo(Math.abs(y), 12), z],
          ]);
        }
      }
    }
    expect([samples.halfHeight, samples.top, samples.finite()]).toEqual([5, 1, true]);
  });

  it("are a unit apart at least in a flat node", () => {
    const samples = new NodeSamples({ ...box, halfZ: 0.25 });
    expect([samples.halfHeight, samples.top]).toEqual([1, 4]);
    expect([BOTTOM, MIDDLE, TOP].map((height) => read(samples, 0, 0, height)[2])).toEqual([29, 30, 31]);
  });

  it("go through a step all at once", () => {
    const samples = new NodeSamples(box);
    const before = read(samples, 2, 7, TOP);
    samples.apply(
      link((state) => {
        state[0] += 1;
        state[2] *= 2;
      }),
    );
    expect(read(samples, 2, 7, TOP)).toEqual([before[0] + 1, before[1], 70]);
    samples.apply(
      link((state) => {
        if (state[2] < 51) state[1] = Number.NaN;
      }),
    );
    expect(samples.finite()).toBe(false);
  });

  it("are as curved as the greatest distance of a middle from its chord, along all axes", () => {
    const straight = new NodeSamples(box);
    straight.apply(
      link((state) => {
        state[0] += 3 * state[2];
        state[1] -= state[2] / 2;
      }),
    );
    expect(straight.curvature()).toBeCloseTo(0, 12);
    // z − 30 is −5, 0 and 5: a parabola a·(z − 30)² leaves its chord by 25 a.
    const bends = [
      [0.3, 0, 0],
      [0, -0.4, 0],
      [0, 0, 0.5],
      [0.2, -0.3, 0.6],
    ];
    for (const bend of bends) {
      const samples = new NodeSamples(box);
      samples.apply(
        link((state) => {
          const square = (state[2] - 30) ** 2;
          for (let axis = 0; axis < 3; axis++) state[axis] += bend[axis] * square;
        }),
      );
      expect(samples.curvature()).toBeCloseTo(25 * Math.hypot(...bend), 9);
    }
    const corner = new NodeSamples(box);
    corner.apply(
      link((state) => {
        if (state[0] > 109.8 && state[1] > -180.4) state[1] += 0.1 * (state[2] - 30) ** 2;
      }),
    );
    expect(corner.curvature()).toBeCloseTo(2.5, 9);
  });
});

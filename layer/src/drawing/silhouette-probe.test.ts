import { describe, expect, it } from "vitest";
import type { DrawnNode, ViewTypes } from "./drawn-node.js";
import type { Middle } from "./silhouette-probe.js";
import { type ProbedFrame, SilhouetteProbe } from "./silhouette-probe.js";

const nodes = [
  { firstId: 0, count: 1 },
  { firstId: 1, count: 1 },
] as DrawnNode[];

/** RGBA bytes of a window: the first node's point in its left half, the second's in its right half. */
function halves({ width, height }: { width: number; height: number }): Uint8Array {
  const pixels = new Uint8Array(4 * width * height);
  for (let at = 0; at < width * height; at++) pixels[4 * at] = at % width < width / 2 ? 1 : 2;
  return pixels;
}

/** A frame whose windows are answered by hand. @param depths eye depth of each node's point, metres */
function frameOf(depths: readonly number[], by: readonly unknown[]) {
  const asked: Middle[][] = [];
  const sent: ((lost: boolean) => void)[] = [];
  const frame: ProbedFrame<ViewTypes> = {
    nodes,
    size: { width: 300, height: 150 },
    by,
    reliefOf: (node) => () => Math.log2(depths[nodes.indexOf(node)]),
    numbersIn(middles, window) {
      asked.push([...middles]);
      return new Promise((resolve) => {
        sent.push((lost) => resolve(middles.map(() => (lost ? undefined : halves(window)))));
      });
    },
  };
  return { frame, asked, answer: (lost = false) => sent.shift()?.(lost) };
}

const turn = () => new Promise((resolve) => setTimeout(resolve));

describe("SilhouetteProbe", () => {
  it("measures a view once, in nine windows spread over the picture", async () => {
    const probe = new SilhouetteProbe<ViewTypes>();
    const { frame, asked, answer } = frameOf([100, 150], ["here"]);
    expect([probe.follow(frame), probe.follow(frame), probe.share]).toEqual([true, true, undefined]);
    answer();
    await turn();
    // Two columns of 48 lie beside the step.
    expect(probe.share).toBeCloseTo(2 / 48, 12);
    expect(probe.follow(frame)).toBe(false);
    expect(asked).toHaveLength(1);
    expect(asked[0][0]).toEqual({ x: 50, y: 25 });
    expect(asked[0][8]).toEqual({ x: 250, y: 125 });
  });

  it("finds a camera at rest that its scene moves by its own rounding in every frame", async () => {
    const probe = new SilhouetteProbe<ViewTypes>();
    const at = 4_376_543.218765432;
    const [first, second, third] = [at, at * (1 + 2 ** -52), at].map((x) => frameOf([100, 150], [x, 0.5]));
    expect(probe.follow(first.frame)).toBe(true);
    first.answer();
    await turn();
    expect([probe.follow(second.frame), probe.follow(third.frame), second.asked.length]).toEqual([
      false,
      false,
      0,
    ]);
    const moved = frameOf([100, 150], [at + 0.1, 0.5]);
    expect(probe.follow(moved.frame)).toBe(true);
  });

  it("waits no more for a measurement that failed", async () => {
    const probe = new SilhouetteProbe<ViewTypes>();
    const { frame } = frameOf([100, 150], ["here"]);
    let fail: (reason: Error) => void = () => {};
    const numbersIn = () => new Promise<never>((_, reject) => (fail = reject));
    const failing = { ...frame, numbersIn };
    // Whoever else listens to this process would take the failure for one of their own.
    const others = process.listeners("unhandledRejection");
    process.removeAllListeners("unhandledRejection");
    const unhandled = new Promise((done) => process.once("unhandledRejection", done));
    expect([probe.follow(failing), probe.follow(failing)]).toEqual([true, true]);
    fail(new Error("out of memory"));
    expect(await unhandled).toMatchObject({ message: "out of memory" });
    for (const other of others) process.on("unhandledRejection", other);
    expect(probe.follow(failing)).toBe(false);
  });

  it("finds no step where depth changes by less than a hundredth", async () => {
    const probe = new SilhouetteProbe<ViewTypes>();
    const { frame, answer } = frameOf([100, 100.9], ["here"]);
    probe.follow(frame);
    answer();
    await turn();
    expect(probe.share).toBe(0);
  });

  it("measures another view once it rests, and keeps the former share until then", async () => {
    const probe = new SilhouetteProbe<ViewTypes>();
    const first = frameOf([100, 150], ["here"]);
    probe.follow(first.frame);
    first.answer();
    await turn();
    const second = frameOf([100, 100], ["there"]);
    expect([probe.follow(second.frame), second.asked.length]).toEqual([true, 0]);
    expect([probe.follow(second.frame), second.asked.length]).toEqual([true, 1]);
    expect(probe.share).toBeCloseTo(2 / 48, 12);
    second.answer();
    await turn();
    expect(probe.share).toBe(0);
  });

  it("takes no answer that comes after it rests, nor one of a lost context", async () => {
    const probe = new SilhouetteProbe<ViewTypes>();
    const { frame, answer } = frameOf([100, 150], ["here"]);
    probe.follow(frame);
    probe.rest();
    answer();
    await turn();
    expect(probe.share).toBeUndefined();
    probe.follow(frame);
    answer(true);
    await turn();
    expect(probe.share).toBeUndefined();
  });
});

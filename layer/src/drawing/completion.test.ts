import { describe, expect, it } from "vitest";
import { Completion, type FrameOutcome } from "./completion.js";

const whole = { wanted: 4, ready: 4, failed: 0, pending: 0 };
const outcome = (parts: Partial<FrameOutcome> = {}): FrameOutcome => ({
  ...{ progress: whole, undrawn: 0, drawn: true, idle: true, pose: () => [0.5] },
  ...parts,
});

describe("Completion", () => {
  it("tells once of a frame that shows all, and of numbers that change", () => {
    const completion = new Completion();
    const loading = outcome({ progress: { ...whole, ready: 1, pending: 3 }, idle: false });
    expect(completion.note(loading)).toEqual({ changed: true, finished: false, done: false });
    expect(completion.settled(true)).toBe(false);
    expect(completion.note(outcome())).toEqual({ changed: true, finished: true, done: true });
    expect(completion.note(outcome())).toEqual({ changed: false, finished: false, done: true });
    expect(completion.settled(true)).toBe(true);
    expect(completion.progress).toEqual(whole);
  });

  it("is done but never finished where a node failed, and neither while something is still to be drawn", () => {
    const completion = new Completion();
    const failed = outcome({ progress: { ...whole, ready: 3, failed: 1 } });
    expect(completion.note(failed)).toEqual({ changed: true, finished: false, done: true });
    expect(completion.note(outcome({ drawn: false }))).toMatchObject({ finished: false, done: false });
    expect(completion.note(outcome({ idle: false }))).toMatchObject({ finished: false, done: true });
  });

  it("counts a node as ready once it is in the picture", () => {
    const completion = new Completion();
    expect(completion.note(outcome({ undrawn: 3, drawn: false }))).toMatchObject({
      finished: false,
      done: false,
    });
    expect(completion.progress).toEqual({ wanted: 4, ready: 1, failed: 0, pending: 3 });
    completion.note(outcome({ undrawn: 9, drawn: false }));
    expect(completion.progress).toEqual({ wanted: 4, ready: 0, failed: 0, pending: 4 });
    expect(completion.note(outcome())).toEqual({ changed: true, finished: true, done: true });
    expect(completion.progress).toEqual(whole);
  });

  it("does not hold for a camera that has moved since, nor for another `show`", () => {
    const completion = new Completion();
    let place = 0.5;
    completion.note(outcome({ pose: () => [place] }));
    place = 0.6;
    expect(completion.settled(true)).toBe(false);
    place = 0.5 + 1e-15;
    expect([completion.settled(true), completion.settled(false)]).toEqual([true, false]);
    completion.rest(false);
    expect([completion.settled(true), completion.settled(false)]).toEqual([false, true]);
    expect(completion.progress.wanted).toBe(0);
  });
});

import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { cloudOf, PLACE, type Points, UTM, withPoints } from "../cloud.fixture.js";
import { Plan } from "./local-plan.js";
import { readPoints } from "./read-points.js";

const [X, Y] = PLACE;

/** 100,000 points in one node, every third of the ground. */
const points: Points = Array.from({ length: 100_000 }, (_, i) => [
  i % 400,
  Math.floor(i / 400),
  i / 1000,
  i % 3,
]);
const cloud = withPoints(cloudOf(UTM), points);
const plan = () =>
  new Plan(cloud, [
    [X, Y, 0],
    [X + 400, Y + 250, 0],
  ]);

describe("points of a rectangle", () => {
  // A machine on which every look at the clock finds the time used up.
  beforeEach(() => {
    let now = 0;
    vi.spyOn(performance, "now").mockImplementation(() => (now += 100));
  });
  afterEach(() => vi.restoreAllMocks());

  it.each([undefined, new Set([2])])(
    "are read a few at a time, and the thread is given back in between",
    async (classes) => {
      const of = plan();
      const take = vi.spyOn(of, "take");
      let [others, done] = [0, false];
      const other = () => {
        others++;
        if (!done) setImmediate(other);
      };
      setImmediate(other);
      const parts = await readPoints(cloud, [X - 1, Y - 1, X + 401, Y + 251], { plan: of, classes });
      done = true;
      const count = parts.reduce((sum, { length }) => sum + length / 3, 0);
      expect(count).toBe(classes ? 33_333 : 100_000);
      // Whatever a node holds: at most 2^14 of its points between two turns of everybody else.
      const most = Math.max(...take.mock.calls.map(([xyz]) => xyz.length / 3));
      expect(most).toBeLessThanOrEqual(2 ** 14);
      expect(others).toBeGreaterThanOrEqual(Math.floor(100_000 / 2 ** 14));
    },
  );

  it("stop with the signal's reason between two of them", async () => {
    const of = plan();
    const stop = new AbortController();
    let taken = 0;
    vi.spyOn(of, "take").mockImplementation((xyz) => {
      if (++taken === 2) stop.abort(new Error("enough"));
      return xyz;
    });
    const reading = readPoints(cloud, [X - 1, Y - 1, X + 401, Y + 251], { plan: of, signal: stop.signal });
    await expect(reading).rejects.toThrow("enough");
    expect(taken).toBe(2);
  });
});

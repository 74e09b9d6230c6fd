import { describe, expect, it } from "vitest";
import { createPace } from "./pace.js";

/** A pace whose clock the test moves on, in seconds. */
function clocked() {
  let seconds = 0;
  const pace = createPace(() => seconds * 1000);
  return {
    at(time: number, stage: string, done: number, total: number) {
      seconds = time;
      return pace.advance(stage, done, total);
    },
  };
}

describe("the pace of a conversion", () => {
  it("is counted from the beginning of each stage", () => {
    const pace = clocked();
    expect(pace.at(0, "read", 0, 1000)).toEqual({ rate: 0, eta: null, overall: 0 });
    expect(pace.at(2, "read", 500, 1000).rate).toBe(250);
    expect(pace.at(4, "build", 0, 1000).rate).toBe(0);
    expect(pace.at(5, "build", 800, 1000).rate).toBe(800);
  });

  it("forecasts the end of the whole, and grows from stage to stage", () => {
    const pace = clocked();
    pace.at(0, "read", 0, 100);
    const shares = ["read", "build", "write"].flatMap((stage, index) =>
      [0, 50, 100].map((done) => pace.at(10 + index, stage, done, 100).overall),
    );
    expect(shares).toEqual([...shares].sort((a, b) => a - b));
    expect(shares.at(-1)).toBeCloseTo(1, 12);
    const half = clocked();
    half.at(0, "read", 0, 100);
    const { eta, overall } = half.at(10, "read", 100, 100);
    expect(eta).toBe(Math.round((10 * (1 - overall)) / overall));
  });

  it("takes PDAL's part into account as soon as there is one", () => {
    const without = clocked().at(1, "read", 50, 100).overall;
    const pace = clocked();
    const inspected = pace.at(0, "inspect", 1, 1).overall;
    expect(pace.at(1, "read", 50, 100).overall).toBeGreaterThan(inspected);
    expect(pace.at(1, "read", 50, 100).overall).toBeGreaterThan(without);
  });
});

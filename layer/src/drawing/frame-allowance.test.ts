import { describe, expect, it } from "vitest";
import { FrameAllowance } from "./frame-allowance.js";

describe("FrameAllowance", () => {
  it("grants steps until its time is spent", () => {
    let now = 100;
    const allowance = new FrameAllowance(() => now, 4);
    const granted: boolean[] = [];
    for (let step = 0; step < 6; step++) {
      granted.push(allowance.grants());
      now += 1.5;
    }
    expect(granted).toEqual([true, true, true, false, false, false]);
    expect(allowance.left).toBe(false);
  });

  it("grants the first step though its time was spent on something else", () => {
    let now = 0;
    const allowance = new FrameAllowance(() => now, 4);
    now = 50;
    expect(allowance.left).toBe(false);
    expect([allowance.grants(), allowance.grants()]).toEqual([true, false]);
  });
});

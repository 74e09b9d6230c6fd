import { describe, expect, it, vi } from "vitest";
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

  it("leaves its last part half of the time, or what is left of it", () => {
    let now = 0;
    const allowance = new FrameAllowance(() => now, 4);
    now = 1;
    const early = allowance.last();
    now = 3.9;
    expect(early.left).toBe(true);
    now = 4;
    expect(early.left).toBe(false);
    now = 50;
    const late = allowance.last();
    now = 51.9;
    expect(late.left).toBe(true);
    now = 52;
    expect(late.left).toBe(false);
  });

  it("grows with the length of frames, within bounds", () => {
    vi.spyOn(performance, "now").mockReturnValue(0);
    const lasts = (frame: number, milliseconds: number, shown = true) => {
      vi.mocked(performance.now).mockReturnValue(0);
      const allowance = FrameAllowance.after(frame, shown);
      return [milliseconds - 0.01, milliseconds].map((time) => {
        vi.mocked(performance.now).mockReturnValue(time);
        return allowance.left;
      });
    };
    expect(lasts(0, 4)).toEqual([true, false]);
    expect(lasts(8, 4)).toEqual([true, false]);
    expect(lasts(60, 15)).toEqual([true, false]);
    expect(lasts(900, 25)).toEqual([true, false]);
    expect(lasts(900, 225, false), "nothing is shown yet").toEqual([true, false]);
    expect(lasts(8, 4, false)).toEqual([true, false]);
    vi.restoreAllMocks();
  });
});

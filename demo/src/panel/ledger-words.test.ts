import type { LedgerRow } from "@groma/layer/cesium";
import { describe, expect, it } from "vitest";
import { costWords, effectWords, frameWords, magnitudeWords, stateWords } from "./ledger-words.js";

const row: LedgerRow = {
  effect: "adaptiveSize",
  magnitude: 3.1364,
  unit: "px",
  threshold: 1,
  active: true,
  why: "two levels meet",
  source: "thesis, 4.3",
  cost: undefined,
};

describe("words for the ledger", () => {
  it("holds a magnitude against its threshold", () => {
    expect(magnitudeWords(row)).toBe("3.14 / 1 px");
    expect(magnitudeWords({ ...row, magnitude: Number.NaN })).toBe("? / 1 px");
    expect(magnitudeWords({ ...row, magnitude: 2.5e-7, unit: "m", threshold: 0.001 })).toBe(
      "2.5E-7 / 0.001 m",
    );
  });

  it("names effects, counts and frames as a reader would", () => {
    expect(effectWords({ ...row, effect: "eyeDomeLighting" })).toBe("eye dome lighting");
    expect(magnitudeWords({ ...row, effect: "clip", magnitude: 2, threshold: 1, unit: "1" })).toBe("2 / 1");
    expect(frameWords({ points: 12.345, picture: 1.5 })).toBe(
      "Last frame on the GPU: points 12.3 ms, light and blending 1.5 ms.",
    );
    expect(frameWords({ points: undefined, picture: undefined })).toBe("");
  });

  it("tells who wanted it, and what it takes", () => {
    expect(stateWords(row)).toBe("on");
    expect(stateWords({ ...row, active: false, why: "forced off" })).toBe("off, forced");
    expect(costWords(undefined)).toBe("");
    expect(costWords({ value: 1.2345, unit: "ms per frame", by: "timer query" })).toBe("1.23 ms");
  });
});

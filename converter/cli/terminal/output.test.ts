import { describe, expect, it } from "vitest";
import { atMost, fixed, length, rounded } from "./output.js";

describe("numbers for people", () => {
  it("state an accuracy that is never smaller than it is", () => {
    expect([5.0011, 5, 0.3, 0.07, 0.031, 0.00002, 1, 12_345].map(atMost)).toEqual([
      "5.1 m",
      "5 m",
      "30 cm",
      "7 cm",
      "3.1 cm",
      "0.02 mm",
      "1 m",
      "13 km",
    ]);
    expect([5.0011, 0.3].map(length)).toEqual(["5 m", "30 cm"]);
  });

  it("are rounded without exponents, and never to minus nothing", () => {
    expect([412.3, 14_312, 0.13496].map((value) => rounded(value, 3))).toEqual(["412", "14,300", "0.135"]);
    expect([-0.001, 2.345, -1].map((value) => fixed(value, 2))).toEqual(["0.00", "2.35", "-1.00"]);
  });
});

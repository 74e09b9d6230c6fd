import { describe, expect, it } from "vitest";
import { GRADIENTS, type GradientName, gradientAt } from "./gradients.js";

describe("gradients", () => {
  it.each(["viridis", "cividis", "greyscale"] as GradientName[])("%s grows lighter all the way", (name) => {
    // Luma of ITU-R BT.709.
    const luma = GRADIENTS[name].map(({ color: [r, g, b] }) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
    expect(luma).toEqual([...luma].sort((a, b) => a - b));
  });

  it("are linear between stops, and end with them", () => {
    const stops = [
      { at: 0.2, color: [0, 0, 0] as const },
      { at: 0.4, color: [1, 0.5, 0] as const },
      { at: 0.4, color: [0, 0, 1] as const },
    ];
    expect(gradientAt(stops, 0)).toEqual([0, 0, 0]);
    expect(gradientAt(stops, 0.25).map((part) => Number(part.toFixed(6)))).toEqual([0.25, 0.125, 0]);
    expect(gradientAt(stops, 1)).toEqual([0, 0, 1]);
  });
});

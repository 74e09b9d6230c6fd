import { describe, expect, it } from "vitest";
import { GRADIENT_NAMES, GRADIENTS, type GradientName, gradientAt, gradientTexture } from "./gradients.js";

describe("gradients", () => {
  it.each(["viridis", "cividis", "greyscale"] as GradientName[])("%s grows lighter all the way", (name) => {
    // Luma of ITU-R BT.709.
    const luma = GRADIENTS[name].map(({ color: [r, g, b] }) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
    expect(luma).toEqual([...luma].sort((a, b) => a - b));
  });

  it("begin and end as published", () => {
    const hexes = Object.fromEntries(
      Object.entries(GRADIENTS).map(([name, stops]) => [
        name,
        [stops[0], stops[1], stops[stops.length - 1]].map(({ color }) =>
          color
            .map((part) =>
              Math.round(255 * part)
                .toString(16)
                .padStart(2, "0"),
            )
            .join(""),
        ),
      ]),
    );
    expect(hexes).toMatchObject({
      viridis: ["440154", "482475", "fde725"],
      cividis: ["002051", "0a326a", "fdea45"],
      turbo: ["23171b", "493eae", "900c00"],
      spectral: ["5e4fa2", "3288bd", "9e0142"],
      greyscale: ["000000", "ffffff", "ffffff"],
    });
    for (const name of GRADIENT_NAMES) {
      const stops = GRADIENTS[name];
      expect(stops.map(({ at }) => at)).toEqual(stops.map((_, index) => index / (stops.length - 1)));
    }
    expect(GRADIENT_NAMES).toEqual(["viridis", "cividis", "turbo", "spectral", "greyscale", "terrain"]);
  });

  it("fill a texture from end to end, those named and those given", () => {
    const given = [
      { at: 0, color: [0, 0, 0] as const },
      { at: 1, color: [1, 0.5, 0] as const },
    ];
    const { name, width, height, data } = gradientTexture(given);
    expect([name, width, height, data.length]).toEqual(["u_gradient", 256, 1, 1024]);
    for (let texel = 0; texel < 256; texel++) {
      const expected = [texel, Math.round(texel / 2), 0, 255];
      expect([...data.subarray(4 * texel, 4 * texel + 4)]).toEqual(expected);
    }
    const named = gradientTexture("greyscale").data;
    expect([named[0], named[4 * 128], named[4 * 255 + 2]]).toEqual([0, 128, 255]);
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
    expect(gradientAt(stops, 0.2)).toEqual([0, 0, 0]);
    // Where two stops meet, the first one ends; just behind it the second one has begun.
    expect(gradientAt(stops, 0.4)).toEqual([1, 0.5, 0]);
    expect(gradientAt(stops, 0.4 + 1e-12)).toEqual([0, 0, 1]);
    expect(gradientAt([{ at: 0.5, color: [0.1, 0.2, 0.3] }], Number.NaN)).toEqual([0.1, 0.2, 0.3]);
  });
});

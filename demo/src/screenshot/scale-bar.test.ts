import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { scaleBar } from "./scale-bar.js";

const english = { length: "metres", locale: "en-GB" } as const;

describe("the scale bar", () => {
  it.each<[number, Parameters<typeof scaleBar>[2], string, number]>([
    [0.5, english, "100 m", 100],
    [0.249, english, "20 m", 20],
    [12, english, "2 km", 2000],
    [0.0009, english, "10 cm", 0.1],
    [0.5, { ...english, length: "feet" }, "200 ft", 60.96],
    [0.5, { ...english, length: "usSurveyFeet" }, "200 ft", 60.96],
    [50, { ...english, length: "miles" }, "5 mi", 8046.72],
    [0.001, { ...english, length: "yards" }, "5 in", 0.127],
    [12, { length: "nauticalMiles", locale: "de-DE" }, "2 km", 2000],
    [60_000, { length: "metres", locale: "fr-FR" }, "10 000 km", 1e7],
  ])("of %d metres a pixel and %o reads %s", (metresPerPixel, words, label, metres) => {
    const bar = scaleBar(metresPerPixel, 200, words);
    expect(bar.label.replaceAll(/[\u00a0\u202f]/g, " ")).toBe(label);
    expect(bar.metres).toBeCloseTo(metres, 9);
    expect(bar.pixels).toBeCloseTo(metres / metresPerPixel, 6);
  });

  it("is as long as its label says, and takes between two fifths and all of the room", () => {
    fc.assert(
      fc.property(fc.double({ min: 1e-5, max: 1e5, noNaN: true }), (metresPerPixel) => {
        const { pixels, metres } = scaleBar(metresPerPixel, 200, english);
        expect((pixels * metresPerPixel) / metres).toBeCloseTo(1, 12);
        expect(pixels).toBeLessThanOrEqual(200 * (1 + 1e-12));
        // Thousands of a unit are the next one's.
        expect(pixels).toBeGreaterThan(79.9);
      }),
    );
  });
});

import { describe, expect, it } from "vitest";
import { GRADIENTS } from "../../layer/src/effects/index.js";
import { styleOf } from "../../layer/src/effects/scene.fixture.js";
import { draw, usePage } from "./effect-draw.js";

const page = usePage();

/** Holds three numbers against a colour, to a step of 8 bits. */
function expectColour(values: readonly number[], from: number, color: readonly number[]): void {
  for (const [i, part] of color.entries()) expect(values[from + i]).toBeCloseTo(part, 2);
}

describe("colours on the GPU", () => {
  it("of a scalar are the gradient's, over the range, with what lies beyond at its ends", async () => {
    const stored = [0, 100, 250, 400, 500, 900];
    const { values } = await draw(
      page(),
      {
        style: { color: "gpsTime", gradient: "spectral", range: [2e8 + 1, 2e8 + 5] },
        node: { columns: { get: () => ({ scale: 0.01, offset: 2e8 }) } },
        columns: { position: stored.flatMap(() => [0, 0, -5]), gpsTime: stored },
      },
      ["v_color"],
    );
    const stops = GRADIENTS.spectral;
    // Stored 100 is the range's least value, 500 its greatest; 250 lies at 0.375, between stops 3 and 4 of 10.
    const between = stops[3].color.map((part, i) => part + 0.75 * (stops[4].color[i] - part));
    const expected = [stops[0].color, stops[0].color, between, undefined, stops[10].color, stops[10].color];
    expected.forEach((color, point) => {
      if (color) expectColour(values, 3 * point, color);
    });
  });

  it("of a constant column are right where its numbers are large", async () => {
    const { values } = await draw(
      page(),
      {
        style: { color: "gpsTime", gradient: "greyscale" },
        node: { columns: { get: () => ({ scale: 1, offset: 0, constant: [2e8 + 900] }) } },
        columns: { position: [0, 0, -5], gpsTime: [0] },
      },
      ["v_color"],
    );
    expect(values[0]).toBeCloseTo(0.25, 5);
  });

  it("of classes are the table's, as it was edited", async () => {
    const classes = { ...styleOf().classes, 6: { name: "roof", color: [1, 0, 0.5] as const, show: true } };
    const { values } = await draw(
      page(),
      {
        style: { color: "classification", classes },
        columns: { position: [0, 0, -5, 0, 0, -5], classification: [6, 2] },
      },
      ["v_color"],
    );
    expect(values[0]).toBeCloseTo(1, 2);
    expect(values[2]).toBeCloseTo(0.5, 2);
    expectColour(values, 3, styleOf().classes[2].color);
  });

  it("are blended by their shares, and toned", async () => {
    const { values } = await draw(
      page(),
      {
        style: { color: "rgb", blend: { color: "intensity", share: 0.25 }, gradient: "greyscale", gamma: 2 },
        node: { columns: { get: () => ({ scale: 1, offset: 0 }) } },
        columns: { position: [0, 0, -5], rgb: [127.5, 255, 0, 255], intensity: [3200] },
      },
      ["v_color"],
    );
    const grey = 0.8 ** 2;
    const blended = [0.25, 1, 0].map((part) => 0.75 * part + 0.25 * grey);
    expectColour(values, 0, blended);
  });
});

import { describe, expect, it } from "vitest";
import { type PointFilter, recordTest } from "../../layer/src/effects/index.js";
import { styleOf } from "../../layer/src/effects/scene.fixture.js";
import { draw, random, usePage } from "./effect-draw.js";

const page = usePage();

describe("filters on the GPU", () => {
  it("leave the same points as on exact records", async () => {
    const filter: PointFilter = {
      classes: [2, 6, 255],
      returns: ["last", "first"],
      ranges: { intensity: [100, 60_000], elevation: [12.34, 80] },
    };
    const next = random(6);
    const scales: Record<string, { scale: number; offset: number }> = {
      elevation: { scale: 0.01, offset: 12 },
    };
    const points = Array.from({ length: 800 }, () => {
      const of = 1 + Math.floor(3 * next());
      return {
        classification: [2, 6, 7, 255][Math.floor(4 * next())],
        numberOfReturns: of,
        returnNumber: 1 + Math.floor(of * next()),
        intensity: [99, 100, 101, 59_999, 60_000, 60_001][Math.floor(6 * next())],
        // Stored numbers around the ends of the range.
        elevation: [33, 34, 35, 6799, 6800, 6801][Math.floor(6 * next())],
      };
    });
    const column = (name: keyof (typeof points)[0]) => points.map((point) => point[name]);
    const { values } = await draw(
      page(),
      {
        facts: { filter },
        node: { columns: { get: (name) => scales[name] ?? { scale: 1, offset: 0 } } },
        columns: {
          position: points.flatMap(() => [0, 0, -5]),
          rgb: points.flatMap(() => [255, 255, 255, 255]),
          classification: column("classification"),
          numberOfReturns: column("numberOfReturns"),
          returnNumber: column("returnNumber"),
          intensity: column("intensity"),
          elevation: column("elevation"),
        },
      },
      ["gl_Position"],
    );
    const drawn = points.map((_, point) => values[4 * point] !== 2);
    // Hundredths over 12, as a record has them.
    const records = points.map((point) => ({ ...point, elevation: point.elevation * 0.01 + 12 }));
    const passes = recordTest(filter, styleOf(), (name) => ({
      value: (record) => records[record]![name as keyof (typeof records)[number]],
      step: name === "elevation" ? 0.01 : 1,
    }));
    const kept = records.map((_, record) => passes(record));
    expect(drawn).toEqual(kept);
    expect(new Set(kept).size).toBe(2);
  });
});

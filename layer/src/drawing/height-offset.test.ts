import { geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { checkHeightOffset, liftOf } from "./height-offset.js";

describe("liftOf", () => {
  it("goes along the ellipsoid's normal", () => {
    const place = new Float64Array(3);
    const higher = new Float64Array(3);
    for (const [longitude, latitude] of [
      [0.1, 0.8],
      [-2.1, -0.4],
      [0, Math.PI / 2],
    ]) {
      geodeticToEcef(longitude, latitude, 120, place);
      geodeticToEcef(longitude, latitude, 107.5, higher);
      const lift = liftOf({ x: place[0], y: place[1], z: place[2] }, -12.5);
      for (let axis = 0; axis < 3; axis++) expect(place[axis] + lift[axis]).toBeCloseTo(higher[axis], 7);
    }
  });
});

describe("checkHeightOffset", () => {
  it.each([0, -10_000, 10_000, 0.25])("takes %s", (metres) =>
    expect(checkHeightOffset(metres, "a")).toBe(metres),
  );

  it.each([Number.NaN, 10_001, Number.NEGATIVE_INFINITY])("STYLE_HEIGHT_OFFSET for %s", (metres) =>
    expect(() => checkHeightOffset(metres, "a")).toThrow(
      expect.objectContaining({ code: "STYLE_HEIGHT_OFFSET", name: "StyleError" }),
    ),
  );
});

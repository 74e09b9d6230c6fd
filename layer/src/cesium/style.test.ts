import { describe, expect, it } from "vitest";
import { completeStyle, defaultStyle, type PointCloudStyle } from "./style.js";

const base: PointCloudStyle = { color: "elevation", pointSize: 2 };
const complete = (parts: Partial<PointCloudStyle>, hasColour = true) =>
  completeStyle(parts, base, hasColour, "a.copc.laz");

describe("style", () => {
  it("keeps what is not given", () => {
    expect(complete({ pointSize: 5 })).toEqual({ color: "elevation", pointSize: 5 });
    expect(complete({ color: "rgb" })).toEqual({ color: "rgb", pointSize: 2 });
  });

  it("begins with the scan's own colours where it has some", () => {
    expect([defaultStyle(true).color, defaultStyle(false).color]).toEqual(["rgb", "elevation"]);
  });

  it.each<[string, Partial<PointCloudStyle>, boolean]>([
    ["STYLE_COLOR", { color: "heat" as "rgb" }, true],
    ["STYLE_NO_RGB", { color: "rgb" }, false],
    ["STYLE_POINT_SIZE", { pointSize: 0 }, true],
    ["STYLE_POINT_SIZE", { pointSize: Number.NaN }, true],
    ["STYLE_POINT_SIZE", { pointSize: 65 }, true],
  ])("%s for %j", (code, parts, hasColour) => {
    expect(() => complete(parts, hasColour)).toThrow(expect.objectContaining({ code, name: "StyleError" }));
  });
});

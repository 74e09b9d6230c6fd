import { describe, expect, it } from "vitest";
import { ATTRIBUTE_LOCATIONS, VIRIDIS, vertexShader } from "./shaders.js";

describe("vertexShader", () => {
  it.each([
    ["rgb", ["a_position", "a_color"]],
    ["elevation", ["a_position", "a_elevation"]],
    ["intensity", ["a_position", "a_intensity"]],
  ] as const)("for %s takes in what it needs and nothing else", (colourBy, attributes) => {
    const shader = vertexShader(colourBy);
    const taken = Object.keys(ATTRIBUTE_LOCATIONS).filter((name) => new RegExp(`\\b${name}\\b`).test(shader));
    expect(taken).toEqual(attributes);
    expect(shader.includes("u_intensityRange")).toBe(colourBy === "intensity");
    expect(shader.includes("RAMP")).toBe(colourBy === "elevation");
  });
});

describe("VIRIDIS", () => {
  it("grows lighter all the way, so that higher is lighter", () => {
    // Luma of ITU-R BT.709.
    const luma = VIRIDIS.map(([red, green, blue]) => 0.2126 * red + 0.7152 * green + 0.0722 * blue);
    expect(luma).toEqual([...luma].sort((a, b) => a - b));
  });
});

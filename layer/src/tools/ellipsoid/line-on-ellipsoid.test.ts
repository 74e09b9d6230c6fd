import { expect, it } from "vitest";
import { lineOnEllipsoid } from "./line-on-ellipsoid.js";

const DEGREE = Math.PI / 180;
const radians = (...line: [number, number][]) => line.map(([x, y]) => [x * DEGREE, y * DEGREE] as const);

it("a line has a plane about its middle, across 180° too, and none where that would be far away", () => {
  const { middle, vertices } = lineOnEllipsoid(radians([179, 10], [-179, 10]), "line.geojson");
  expect(middle[0]).toBeCloseTo(Math.PI, 12);
  expect(vertices[0][0]).toBeCloseTo(-vertices[1][0], 6);
  expect(() => lineOnEllipsoid(radians([0, 45], [0, 53.9]), "line.geojson")).not.toThrow();
  for (const far of [
    [0, 45, 0, 54.1],
    [7.30131, 47.233, -172.7, 47.2339],
    [0, 0, 180, 0],
    [0, 90, 0, -90],
  ]) {
    const line = radians([far[0], far[1]], [far[2], far[3]]);
    expect(() => lineOnEllipsoid(line, "line.geojson")).toThrow(
      expect.objectContaining({
        code: "PLACE_LINE",
        message: expect.stringMatching(/line\.geojson.*500 km/s),
      }),
    );
  }
});

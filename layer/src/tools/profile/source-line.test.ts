import { ecefToGeodetic, PlacementError, pointTransform, truthOf } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { sourceLine } from "./source-line.js";

const utm = {
  proj4: "+proj=utm +zone=32 +datum=WGS84",
  horizontalUnit: { kind: "linear", name: "metre", size: 1, declared: true },
  verticalUnit: { kind: "linear", name: "metre", size: 1, declared: true },
  height: { kind: "ellipsoidal" },
} as const;

const transform = pointTransform(truthOf({ crs: utm as never }, 100, "scan"));
const space = {
  boundingBox: { min: [500000, 5200000, 0], max: [501000, 5201000, 200] },
  place(x: number, y: number, z: number, out: Float64Array) {
    transform(x, y, z, out, 0);
    return out;
  },
} as const;

/** Longitude and latitude of a place, radians. */
function angles(x: number, y: number): [number, number] {
  const ecef = space.place(x, y, 100, new Float64Array(3));
  const geodetic = new Float64Array(3);
  ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic);
  return [geodetic[0], geodetic[1]];
}

describe("a line in the plane of a data set", () => {
  it("is found to a micrometre, with turns of longitude left out", () => {
    const wanted = [
      [500000, 5200000],
      [500500.123, 5200321.5],
      [501000, 5201000],
    ] as const;
    const line = wanted.map(([x, y]) => angles(x, y));
    line[1][0] += 2 * Math.PI;
    for (const [index, [x, y]] of sourceLine(space, line, "line").entries()) {
      expect(Math.hypot(x - wanted[index][0], y - wanted[index][1])).toBeLessThan(1e-6);
    }
  });

  it("goes on beyond the data set's bounds, where its map is carried on linearly", () => {
    const [[x, y]] = sourceLine(space, [angles(501300, 5199800)], "line");
    expect(Math.hypot(x - 501300, y - 5199800)).toBeLessThan(0.05);
  });

  it.each([9, 0.02])(
    "is found in and around a scan of %d m, however little float64 leaves of a step",
    (size) => {
      const [x0, y0] = [500123.45, 5499876.54];
      const small = {
        ...space,
        boundingBox: { min: [x0, y0, 95], max: [x0 + size, y0 + size, 105] },
      } as const;
      for (let index = 0; index < 50; index++) {
        for (const [far, accuracy] of [
          [size, 1e-6],
          [50, 1e-3],
          [3000, 3],
        ]) {
          const [x, y] = [x0 + far * Math.sin(index), y0 + far * Math.cos(3 * index)];
          const [[foundX, foundY]] = sourceLine(small, [angles(x, y)], "line");
          const inside = x >= x0 && x <= x0 + size && y >= y0 && y <= y0 + size;
          expect(Math.hypot(foundX - x, foundY - y)).toBeLessThan(inside ? 1e-6 : accuracy);
        }
      }
    },
  );

  it.each([
    ["of one point", 0, 0],
    ["of a wall along y", 0, 12],
    ["of a line along x", 12, 0],
  ])("is found beside a scan %s, whose own map ends a few millimetres around it", (_which, width, depth) => {
    const [x0, y0] = [500123.456, 5499876.543];
    const [x1, y1] = [x0 + width, y0 + depth];
    const flat = {
      boundingBox: { min: [x0, y0, 95], max: [x1, y1, 95] },
      place(x: number, y: number, z: number, out: Float64Array) {
        const beyond = Math.max(x0 - x, x - x1, y0 - y, y - y1);
        if (beyond > 0.006) throw new PlacementError({ code: "PLACE_DOMAIN", file: "", cause: "", fix: "" });
        return space.place(x, y, z, out);
      },
    } as const;
    for (const [dx, dy] of [
      [0, 0],
      [3, -4],
      [-20, 30],
    ]) {
      const [[x, y]] = sourceLine(flat, [angles(x0 + dx, y0 + dy)], "line");
      expect(Math.hypot(x - x0 - dx, y - y0 - dy)).toBeLessThan(1e-3);
    }
  });

  it("has no vertices without a place", () => {
    expect(() => sourceLine(space, [angles(500100, 5200100), [Number.NaN, 0]], "line.geojson")).toThrow(
      /line.geojson: vertex 2 has no place/,
    );
  });
});

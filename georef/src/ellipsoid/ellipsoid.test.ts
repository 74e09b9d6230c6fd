import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { distance } from "../cartesian/points.fixture.js";
import { eastNorthUp, ecefToGeodetic, geodeticToEcef, WGS84 } from "../index.js";

const out = new Float64Array(3);
const back = new Float64Array(3);

/** How far ECEF → geodetic → ECEF leads from where it began, metres. */
function roundTrip(x: number, y: number, z: number): number {
  ecefToGeodetic(x, y, z, out);
  geodeticToEcef(out[0], out[1], out[2], back);
  return distance(back, [x, y, z]);
}

const finite = (min: number, max: number) => fc.double({ min, max, noNaN: true, noDefaultInfinity: true });

describe("ECEF ↔ geodetic", () => {
  it("comes back to 10 nm anywhere from the centre to 10,000 km up", () => {
    const axis = finite(-1.6e7, 1.6e7);
    fc.assert(
      fc.property(axis, axis, axis, (x, y, z) => roundTrip(x, y, z) < 1e-8),
      { numRuns: 20000 },
    );
  });

  it("comes back to 10 nm inside the evolute, where two or four normals meet", () => {
    // The evolute reaches a·e² = 42.7 km from the centre in the equator and b·e'² = 42.8 km along the axis.
    const axis = finite(-43000, 43000);
    fc.assert(
      fc.property(axis, axis, axis, (x, y, z) => roundTrip(x, y, z) < 1e-8),
      { numRuns: 20000 },
    );
  });

  it("comes back to 10 nm near the axis, down to a nanometre from it", () => {
    const near = fc.tuple(finite(-9, 3), finite(0, 2 * Math.PI), finite(-1e7, 1e7));
    fc.assert(
      fc.property(near, ([exponent, angle, z]) => {
        const r = 10 ** exponent;
        return roundTrip(r * Math.cos(angle), r * Math.sin(angle), z) < 1e-8;
      }),
      { numRuns: 20000 },
    );
  });

  it.each([
    ["north pole", [0, 0, 6356752.314245179], [0, Math.PI / 2, 0]],
    ["south pole", [0, 0, -6356752.314245179], [0, -Math.PI / 2, 0]],
    ["centre", [0, 0, 0], [0, Math.PI / 2, -6356752.314245179]],
    ["antimeridian", [-6378137, 0, 0], [Math.PI, 0, 0]],
  ])("gives the %s its name", (_, [x, y, z], want) => {
    ecefToGeodetic(x, y, z, out);
    expect(out[0]).toBeCloseTo(want[0], 12);
    expect(out[1]).toBeCloseTo(want[1], 12);
    expect(out[2]).toBeCloseTo(want[2], 8);
  });

  it("returns the geodetic coordinates that it was given, as far as a nanoradian and 10 nm", () => {
    const place = fc.tuple(finite(-Math.PI, Math.PI), finite(-Math.PI / 2, Math.PI / 2), finite(-6e6, 4e8));
    fc.assert(
      fc.property(place, ([longitude, latitude, height]) => {
        geodeticToEcef(longitude, latitude, height, back);
        ecefToGeodetic(back[0], back[1], back[2], out);
        const east = Math.abs(Math.sin(out[0] - longitude)) * Math.cos(latitude);
        return (
          east < 1e-9 &&
          Math.abs(out[1] - latitude) < 1e-9 &&
          Math.abs(out[2] - height) < 1e-8 + 1e-15 * Math.abs(height)
        );
      }),
      { numRuns: 20000 },
    );
  });

  it("writes at the offset it is given and nowhere else", () => {
    const wide = new Float64Array(5).fill(7);
    geodeticToEcef(0, 0, 0, wide, 1);
    expect([...wide]).toEqual([7, WGS84.a, 0, 0, 7]);
  });
});

describe("east-north-up frames", () => {
  it("are orthonormal, right-handed, and up is the normal, poles included", () => {
    const place = fc.tuple(finite(-Math.PI, Math.PI), finite(-Math.PI / 2, Math.PI / 2), finite(-1e4, 1e6));
    fc.assert(
      fc.property(place, ([longitude, latitude, height]) => {
        geodeticToEcef(longitude, latitude, height, out);
        const { rotation: r } = eastNorthUp(out);
        const column = (i: number) => r.subarray(3 * i, 3 * i + 3);
        const dot = (a: Float64Array, b: Float64Array) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        const [east, north, up] = [column(0), column(1), column(2)];
        const unit = [east, north, up].every((axis) => Math.abs(dot(axis, axis) - 1) < 1e-14);
        const square = [dot(east, north), dot(north, up), dot(up, east)].every(
          (value) => Math.abs(value) < 1e-14,
        );
        const handed = Math.abs(east[0] * north[1] - east[1] * north[0] - up[2]) < 1e-14;
        return unit && square && handed && Math.abs(up[2] - Math.sin(latitude)) < 1e-9;
      }),
      { numRuns: 5000 },
    );
  });
});

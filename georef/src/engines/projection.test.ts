import { describe, expect, it } from "vitest";
import { ellipsoid, geodesicBetween, gridPlane, WGS84 } from "../index.js";

const METRE = { name: "metre", kind: "linear", size: 1 } as const;
const LV95 =
  "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +a=6377397.155 +rf=299.1528128 +towgs84=674.374,15.056,405.346";

describe("the plane of a grid", () => {
  it("lies over its own ellipsoid, whatever the shift of datum", () => {
    const plane = gridPlane({ proj4: LV95, horizontalUnit: METRE })!;
    expect(plane.ellipsoid.a).toBeCloseTo(6377397.155, 6);
    const ends = new Float64Array(4);
    plane.toGeodetic(2600000, 1200000, ends, 0);
    plane.toGeodetic(2600010, 1200000, ends, 2);
    expect((ends[1] * 180) / Math.PI).toBeCloseTo(46.9524055555556, 9);
    // The oblique cylinder touches the ellipsoid at Berne.
    expect(geodesicBetween(ends[0], ends[1], ends[2], ends[3], plane.ellipsoid).distance).toBeCloseTo(10, 8);
  });

  it("of the Web Mercator projection is a plane over WGS 84", () => {
    const proj4 =
      "+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +lon_0=0 +x_0=0 +y_0=0 +k=1 +nadgrids=@null +units=m";
    expect(gridPlane({ proj4, horizontalUnit: METRE })?.ellipsoid).toBe(WGS84);
  });

  it("keeps an ellipsoid without datum", () => {
    const proj4 = "+proj=utm +zone=32 +ellps=bessel +units=m";
    expect(gridPlane({ proj4, horizontalUnit: METRE })?.ellipsoid.f).toBeCloseTo(
      ellipsoid(6377397.155, 1 / 299.1528128).f,
      12,
    );
  });

  it("is none where coordinates are angles or geocentric", () => {
    const degree = { name: "degree", kind: "angular", size: Math.PI / 180 } as const;
    expect(gridPlane({ proj4: "+proj=longlat +ellps=WGS84", horizontalUnit: degree })).toBeUndefined();
    expect(gridPlane({ proj4: "+proj=geocent +ellps=WGS84", horizontalUnit: METRE })).toBeUndefined();
  });
});

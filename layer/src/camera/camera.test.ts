import { difference, dot, unit, type Vector, WGS84 } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { headingAt, placeLookedAt } from "./pose.js";
import { cameraAt, DEGREE, distance, ecef, latitude, longitude, number, span } from "./poses.fixture.js";
import { heightOf, horizonBelow, meetSurface, upAt } from "./surface.js";

describe("where a ray meets the places of one height", () => {
  it("lies on the ray and has the height", () => {
    fc.assert(
      fc.property(
        ...[longitude, latitude, number(-400, 9000), span, number(0, 360), number(-90, -3)],
        (lon, lat, height, above, heading, pitch) => {
          const { position, direction } = cameraAt(ecef(lon, lat, height + above), heading, pitch);
          const place = meetSurface({ origin: position, direction }, height);
          if (!place) return;
          const away = difference(place, position);
          expect(Math.abs(dot(away, direction) - Math.hypot(...away))).toBeLessThan(1e-6);
          expect(Math.abs(heightOf(place) - height)).toBeLessThan(1e-6);
          // The nearer of two: the surface is met from above.
          expect(dot(direction, upAt(place))).toBeLessThan(0);
        },
      ),
    );
  });

  it("is none beside the earth, behind the camera and from below", () => {
    const { position, direction } = cameraAt(ecef(10, 50, 1000), 0, -0.5);
    expect(meetSurface({ origin: position, direction }, 0)).toBeUndefined();
    const down = cameraAt(ecef(10, 50, 1000), 0, -90).direction;
    expect(meetSurface({ origin: position, direction: down }, 0)).toBeDefined();
    expect(meetSurface({ origin: position, direction: down }, 1001)).toBeUndefined();
    const up = down.map((value) => -value) as unknown as Vector;
    expect(meetSurface({ origin: position, direction: up }, 0)).toBeUndefined();
  });

  it("has a horizon where a line of sight touches", () => {
    fc.assert(
      fc.property(
        longitude,
        latitude,
        span,
        number(0, 360),
        number(-3, 80),
        (lon, lat, above, heading, pitch) => {
          const { position, direction } = cameraAt(ecef(lon, lat, above), heading, pitch);
          const place = horizonBelow({ origin: position, direction }, 0)!;
          const { a, f } = WGS84;
          const b = a * (1 - f);
          expect((place[0] ** 2 + place[1] ** 2) / a ** 2 + place[2] ** 2 / b ** 2).toBeCloseTo(1, 12);
          const normal = unit([place[0] / a ** 2, place[1] / a ** 2, place[2] / b ** 2]);
          expect(Math.abs(dot(normal, unit(difference(place, position))))).toBeLessThan(1e-6);
          // On the side to which the ray goes, seen from above.
          const up = upAt(position);
          const level = direction.map((value, axis) => value - dot(direction, up) * up[axis]);
          expect(dot(difference(place, position), level)).toBeGreaterThan(0);
        },
      ),
    );
  });
});

describe("the place that a camera looks at", () => {
  it("is below a camera that looks down, and ahead of a tilted one, on the ground or what stands on it", () => {
    const down = cameraAt(ecef(8, 47, 500), 30, -90);
    expect(distance(placeLookedAt(down, 400), ecef(8, 47, 400))).toBeLessThan(1e-6);
    // 100 m above, 45°: 100 m ahead; less what the earth curves away from a line that goes on.
    const tilted = cameraAt(ecef(0, 0, 100), 90, -45);
    expect(placeLookedAt(tilted, 0)[1]).toBeCloseTo(100, 2);
    expect(placeLookedAt(tilted, 60)[1]).toBeCloseTo(40, 2);
  });

  it("moves without a jump from the nadir over the horizon to the zenith and beyond", () => {
    for (const [height, most] of [
      [2, 1],
      [100, 50],
      [10_000, 50_000],
      [1e6, 3e5],
      [3e7, 1.5e6],
    ]) {
      let before: Vector | undefined;
      for (let pitch = -90; pitch <= 89.9; pitch += 0.02) {
        const place = placeLookedAt(cameraAt(ecef(7, 51, height), 200, pitch), 0);
        expect(place.every(Number.isFinite)).toBe(true);
        if (before) expect(distance(place, before), `${height} m, ${pitch}°`).toBeLessThan(most);
        before = place;
      }
      // Of what is flatter than one in twenty the place stays at that distance.
      if (height <= 100) expect(distance(before!, ecef(7, 51, 0))).toBeLessThan(21 * height);
    }
  });

  it("is below the camera where the held height is above it", () => {
    const indoors = cameraAt(ecef(7, 51, 10), 0, -45);
    expect(distance(placeLookedAt(indoors, 300), ecef(7, 51, 10))).toBeLessThan(2);
  });
});

describe("the heading", () => {
  it("is the same at every tilt, straight down and past it included", () => {
    for (const pitch of [-90, -89.9999, -45, 0, 60, 90]) {
      const position = ecef(-70, -33, 1000);
      expect(headingAt(cameraAt(position, 77, pitch), position) / DEGREE).toBeCloseTo(77, 9);
    }
    const position = ecef(-70, -33, 1000);
    // Of a picture that is rolled to the right, the upper edge is to the right; level, it is neither here nor there.
    expect(headingAt(cameraAt(position, 77, -30, 90), position) / DEGREE).toBeCloseTo(167, 9);
    expect(headingAt(cameraAt(position, 77, 0, 90), position) / DEGREE).toBeCloseTo(77, 9);
  });
});

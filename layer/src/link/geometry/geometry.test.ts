import { cross, difference, dot, unit } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { headingAt, heightOf, moveCamera, placeLookedAt, upAt } from "../../camera/index.js";
import {
  cameraAt,
  DEGREE,
  distance,
  ecef,
  latitude,
  longitude,
  number,
  span,
} from "../../camera/poses.fixture.js";
import {
  footprintOf,
  geodeticOf,
  type MapView,
  type Plane,
  ringOnMap,
  toGroundView,
  toMapView,
} from "./index.js";
import { PLANES } from "./planes.fixture.js";

/** Metres of ground per pixel at a metre's distance. */
const PER_PIXEL = (2 * Math.tan(0.5)) / 600;

/** Pixels by which the corners and the middle of a picture of 800 × 600 lie elsewhere in another view. */
function drift(a: MapView, b: MapView): number {
  return Math.max(
    ...[
      [0, 0],
      [-400, -300],
      [400, -300],
      [400, 300],
    ].map(([px, py]) => {
      const place = (view: MapView) => {
        const [cosine, sine] = [Math.cos(view.rotation), Math.sin(view.rotation)];
        return [
          view.center[0] + view.resolution * (cosine * px - sine * py),
          view.center[1] + view.resolution * (sine * px + cosine * py),
        ];
      };
      const [[ax, ay], [bx, by]] = [place(a), place(b)];
      return Math.hypot(ax - bx, ay - by) / a.resolution;
    }),
  );
}

describe("map → globe → map", () => {
  /** Middles of the map in reach of its plane, degrees. */
  const middles: Readonly<Record<string, fc.Arbitrary<readonly [number, number]>>> = {
    Mercator: fc.tuple(longitude, number(-85, 85)),
    degrees: fc.tuple(longitude, number(-89.9, 89.9)),
    UTM: fc.tuple(number(4, 14), number(-80, 84)),
    arctic: fc.tuple(longitude, fc.oneof(number(50, 90), fc.constantFrom(90, 89.99999999))),
    antarctic: fc.tuple(longitude, fc.oneof(number(-90, -50), fc.constantFrom(-90, -89.99999999))),
    "equal area": fc.tuple(number(-10, 30), number(35, 70)),
  };

  it.each([...PLANES])("comes back to where it was in %s", (name, plane) => {
    fc.assert(
      fc.property(
        middles[name],
        // Near and tilted at will; from far above, a camera that is tilted looks beside the earth.
        fc.oneof(fc.tuple(number(-3, 1), number(-90, -4)), fc.tuple(number(1, 5.5), number(-90, -80))),
        number(-Math.PI, Math.PI),
        fc.tuple(number(0, 360), number(-40, 40)),
        number(-100, 4000),
        ([lon, lat], [power, pitch], rotation, [heading, roll], height) => {
          const metresPerPixel = 10 ** power;
          const center = plane.forward(lon * DEGREE, lat * DEGREE);
          // A view of that many metres, whatever the unit.
          const unitsPerMetre = toMapView(plane, { place: ecef(lon, lat), heading: 0, metresPerPixel: 1 })!;
          const view: MapView = { center, rotation, resolution: metresPerPixel * unitsPerMetre.resolution };
          const ground = toGroundView(plane, view, height)!;
          // The camera stands anywhere beforehand.
          const start = cameraAt(ecef(20, 10, 2000), heading, pitch, roll);
          const place = placeLookedAt(start, 0);
          const from = { place, heading: headingAt(start, place) };
          const scale = ground.metresPerPixel / (PER_PIXEL * distance(place, start.position));
          const camera = moveCamera(start, from, ground, scale);
          expect(Math.abs(dot(camera.direction, camera.up))).toBeLessThan(1e-9);
          const again = placeLookedAt(camera, height);
          const back = toMapView(
            plane,
            {
              place: again,
              heading: headingAt(camera, again),
              metresPerPixel: PER_PIXEL * distance(again, camera.position),
            },
            center[0],
          )!;
          // The series by which proj4 goes back from equal areas leaves a millimetre.
          const stray = name === "equal area" ? 2e-3 / metresPerPixel : 0;
          expect(drift(view, back)).toBeLessThan(0.05 + stray);
        },
      ),
      { numRuns: 300 },
    );
  });

  it("shows as much ground in the middle, and the same side up", () => {
    // At 60° a metre is two units of Mercator's; on a map in degrees a pixel has as much area.
    const place = ecef(10, 60);
    const mercator = toMapView(PLANES.get("Mercator")!, { place, heading: 0, metresPerPixel: 3 })!;
    expect(mercator.resolution / 3).toBeCloseTo(2, 1);
    expect(mercator.rotation).toBeCloseTo(0, 9);
    const turned = toMapView(PLANES.get("Mercator")!, { place, heading: 0.4, metresPerPixel: 3 })!;
    // A camera that looks to the north-east has the map turned to the left.
    expect(turned.rotation).toBeCloseTo(-0.4, 2);
    // East of its middle meridian, UTM's north lies to the east of the true one.
    const utm = toMapView(PLANES.get("UTM")!, { place: ecef(12, 60), heading: 0, metresPerPixel: 3 })!;
    expect(utm.rotation / DEGREE).toBeCloseTo(3 * Math.sin(60 * DEGREE), 1);
  });

  it("stays in the world that the map shows", () => {
    const plane = PLANES.get("degrees")!;
    const ground = { place: ecef(-179, 10), heading: 0, metresPerPixel: 1 };
    expect(toMapView(plane, ground, 179)!.center[0]).toBeCloseTo(181, 9);
    expect(toMapView(plane, ground, -900)!.center[0]).toBeCloseTo(-899, 9);
  });

  it("has no view of what the map does not have", () => {
    const plane: Plane = { worldWidth: undefined, forward: () => [NaN, NaN], inverse: () => [NaN, NaN] };
    expect(toMapView(plane, { place: ecef(0, 90), heading: 0, metresPerPixel: 1 })).toBeUndefined();
    expect(toGroundView(plane, { center: [0, 0], resolution: 1, rotation: 0 }, 0)).toBeUndefined();
  });
});

describe("the footprint of what a camera sees", () => {
  const halves = { right: 0.8, up: 0.6 };

  it("is the rectangle below a camera that looks down", () => {
    const outline = footprintOf(cameraAt(ecef(0, 0, 100), 0, -90), halves, 0);
    const east = outline.map(([, y]) => y);
    const north = outline.map(([, , z]) => z);
    for (const [found, wanted] of [
      [Math.min(...east), -80],
      [Math.max(...east), 80],
      [Math.min(...north), -60],
      [Math.max(...north), 60],
    ]) {
      expect(found).toBeCloseTo(wanted, 1);
    }
  });

  it("lies on the ground, in the picture, and on its edge or the horizon", () => {
    fc.assert(
      fc.property(
        ...[longitude, latitude, span.map((x) => 5 * x), number(0, 360), number(-90, 20), number(-60, 60)],
        (lon, lat, above, heading, pitch, roll) => {
          const pose = cameraAt(ecef(lon, lat, above), heading, pitch, roll);
          const right = cross(pose.direction, pose.up);
          for (const place of footprintOf(pose, halves, 0)) {
            expect(Math.abs(heightOf(place))).toBeLessThan(0.01);
            const away = difference(place, pose.position);
            const depth = dot(away, pose.direction);
            expect(depth).toBeGreaterThan(0);
            const x = Math.abs(dot(away, right) / depth / halves.right);
            const y = Math.abs(dot(away, pose.up) / depth / halves.up);
            expect(Math.max(x, y)).toBeLessThan(1 + 1e-5);
            const touch = Math.abs(dot(unit(away), upAt(place)));
            expect(Math.max(x, y) > 1 - 1e-5 || touch < 1e-4).toBe(true);
          }
        },
      ),
    );
  });

  it("is the edge of the picture, or the limb, where there is no perspective", () => {
    fc.assert(
      fc.property(
        ...[longitude, latitude, span.map((x) => 5 * x), number(0, 360), number(-90, 20), span],
        (lon, lat, above, heading, pitch, width) => {
          const pose = cameraAt(ecef(lon, lat, above), heading, pitch, 10);
          const right = cross(pose.direction, pose.up);
          const wide = { right: 0.8 * width, up: 0.6 * width, parallel: true };
          for (const place of footprintOf(pose, wide, 0)) {
            expect(Math.abs(heightOf(place))).toBeLessThan(0.01);
            const away = difference(place, pose.position);
            expect(dot(away, pose.direction)).toBeGreaterThan(0);
            const x = Math.abs(dot(away, right) / wide.right);
            const y = Math.abs(dot(away, pose.up) / wide.up);
            expect(Math.max(x, y)).toBeLessThan(1 + 1e-5);
            const touch = Math.abs(dot(pose.direction, upAt(place)));
            expect(Math.max(x, y) > 1 - 1e-5 || touch < 1e-4).toBe(true);
          }
        },
      ),
    );
    // Parallel rays see as much ground from any height: 80 by 60 m.
    const flat = { right: 80, up: 60, parallel: true };
    const outline = footprintOf(cameraAt(ecef(0, 0, 5000), 0, -90), flat, 0);
    expect(Math.max(...outline.map(([, y]) => y))).toBeCloseTo(80, 6);
    expect(Math.min(...outline.map(([, , z]) => z))).toBeCloseTo(-60, 6);
    // And the half of a globe that is seen as a whole, not less as from a place.
    const whole = footprintOf(cameraAt(ecef(20, 0, 3e7), 0, -90), { right: 8e6, up: 8e6, parallel: true }, 0);
    expect(whole.length).toBe(48);
    for (const place of whole) expect(Math.abs(dot(upAt(place), upAt(ecef(20, 0))))).toBeLessThan(1e-6);
  });

  it("is none of the sky, and the horizon round a globe that is seen as a whole", () => {
    expect(footprintOf(cameraAt(ecef(0, 0, 100), 0, 80), halves, 0)).toEqual([]);
    const whole = footprintOf(cameraAt(ecef(20, 0, 3e7), 0, -90), halves, 0);
    expect(whole.length).toBeGreaterThan(40);
    for (const place of whole) {
      expect(Math.abs(dot(unit(difference(place, ecef(20, 0, 3e7))), upAt(place)))).toBeLessThan(1e-6);
    }
  });

  it("goes on over 180°, and along the edge of a map round whose pole it goes", () => {
    const plane = PLANES.get("degrees")!;
    const across = ringOnMap(footprintOf(cameraAt(ecef(180, 0, 1e5), 0, -90), halves, 0), plane, 179);
    const x = across.map(([at]) => at);
    expect(Math.max(...x) - Math.min(...x)).toBeLessThan(2);
    expect((Math.max(...x) + Math.min(...x)) / 2).toBeCloseTo(180, 6);
    const pole = ringOnMap(footprintOf(cameraAt(ecef(0, 90, 1e5), 0, -90), halves, 0), plane, 0);
    const round = pole.map(([at]) => at);
    expect(Math.max(...round) - Math.min(...round)).toBeCloseTo(360, 6);
    expect(Math.max(...pole.map(([, y]) => y))).toBeCloseTo(90, 6);
    expect(Math.min(...pole.map(([, y]) => y))).toBeGreaterThan(88);
    // In the arctic plane it is an ordinary ring.
    const arctic = ringOnMap(
      footprintOf(cameraAt(ecef(0, 90, 1e5), 0, -90), halves, 0),
      PLANES.get("arctic")!,
      0,
    );
    expect(Math.min(...arctic.map(([px, py]) => Math.hypot(px, py)))).toBeGreaterThan(50_000);
  });

  it("leaves out what the map does not have", () => {
    const whole = footprintOf(cameraAt(ecef(20, 0, 3e7), 0, -90), halves, 0);
    for (const [x, y] of ringOnMap(whole, PLANES.get("UTM")!, 0)) {
      expect(Number.isFinite(x) && Number.isFinite(y)).toBe(true);
    }
    const [lon] = geodeticOf(ecef(3, 4));
    expect(lon / DEGREE).toBeCloseTo(3, 12);
  });
});

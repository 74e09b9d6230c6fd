import { cross, difference, dot, type Vector } from "@groma/georef";
import fc from "fast-check";
import { describe, expect, it } from "vitest";
import {
  alongRay,
  type CameraPose,
  headingAt,
  heightOf,
  type Lens,
  meetSurface,
  placeInPicture,
  rayThrough,
  upAt,
} from "../../camera/index.js";
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
import { ALL_PITCHES, carried, orbit, panTo, panWay, pitchOf, step, zoomAbout } from "./index.js";

const half = Math.tan(30 * DEGREE);
const lens: Lens = { width: 800, height: 600, halves: { right: (half * 4) / 3, up: half } };
const parallel = (metres: number): Lens => ({
  ...lens,
  halves: { right: (metres * 4) / 3, up: metres, parallel: true },
});
const screen = fc.record({ x: number(0, 800), y: number(0, 600) });
const heading = number(0, 360);
const angle = number(-Math.PI, Math.PI);
/** A camera and what is under its pointer, at any distance: on the ground, above or below. */
const sight = fc
  .tuple(
    fc.tuple(longitude, latitude, number(-50, 3000)),
    fc.tuple(heading, number(-90, 90)),
    screen,
    number(0, 5).map((power) => 10 ** power),
  )
  .map(([[lon, lat, height], [turn, pitch], at, away]) => {
    const pose = cameraAt(ecef(lon, lat, height), turn, pitch);
    return { pose, at, place: alongRay(rayThrough(pose, lens, at), away) };
  });

/** Pixels between where a place is in the picture and where it should be. */
function stray(pose: CameraPose, place: Vector, at: { x: number; y: number }, by = lens): number {
  const found = placeInPicture(pose, by, place);
  return found ? Math.hypot(found.x - at.x, found.y - at.y) : Number.POSITIVE_INFINITY;
}

/** By how much the axes of a camera are no unit vectors at right angles, or no numbers. */
function defect({ position, direction, up }: CameraPose): number {
  const off = [dot(direction, direction) - 1, dot(up, up) - 1, dot(direction, up)].map(Math.abs);
  return position.every(Number.isFinite) ? Math.max(...off) : Number.NaN;
}

/** Radians by which two cameras are turned against each other, about. */
function turnBetween(a: CameraPose, b: CameraPose): number {
  return distance(a.direction, b.direction) + distance(a.up, b.up);
}

/** Sine of the angle by which a camera leans to its side. */
const roll = (pose: CameraPose) => dot(cross(pose.direction, pose.up), upAt(pose.position));

describe("orbiting", () => {
  it("leaves the picked place where it is in the picture, as far away, at any place of the earth", () => {
    fc.assert(
      fc.property(sight, angle, angle, ({ pose, at, place }, turn, tilt) => {
        const moved = orbit(pose, place, turn, tilt);
        expect(stray(moved, place, at)).toBeLessThan(0.01);
        expect(Math.abs(distance(moved.position, place) / distance(pose.position, place) - 1)).toBeLessThan(
          1e-8,
        );
        expect(defect(moved)).toBeLessThan(1e-12);
      }),
    );
  });

  it("tilts from straight down to straight up, and no further", () => {
    fc.assert(
      fc.property(
        longitude,
        latitude,
        heading,
        fc.array(number(-2, 2), { maxLength: 12 }),
        (lon, lat, to, tilts) => {
          let pose = cameraAt(ecef(lon, lat, 100), to, -40);
          const up = upAt(pose.position);
          for (const tilt of tilts) {
            pose = orbit(pose, pose.position, 0, tilt);
            expect(Math.abs(pitchOf(pose, up))).toBeLessThan(Math.PI / 2 + 1e-6);
          }
          // However often it came to an end, what lay to the right still does.
          const right = cross(pose.direction, pose.up);
          expect(
            dot(right, cross(cameraAt(ecef(lon, lat, 100), to, -40).direction, upAt(pose.position))),
          ).toBeGreaterThan(0);
        },
      ),
    );
    const pose = cameraAt(ecef(9, 50, 100), 20, -40);
    const held = { least: -80 * DEGREE, greatest: 0 };
    expect(pitchOf(orbit(pose, pose.position, 0, 3, held), upAt(pose.position))).toBeCloseTo(0, 9);
    expect(pitchOf(orbit(pose, pose.position, 0, -3, held), upAt(pose.position))).toBeCloseTo(held.least, 9);
  });

  it("comes back from beyond the limits without a jump", () => {
    const pose = cameraAt(ecef(9, 50, 100), 20, 60);
    const held = { least: -80 * DEGREE, greatest: 0 };
    const still = orbit(pose, pose.position, 0, 0.1, held);
    expect(turnBetween(still, pose)).toBeLessThan(1e-9);
    const back = orbit(pose, pose.position, 0, -0.1, held);
    expect(pitchOf(back, upAt(pose.position))).toBeCloseTo(60 * DEGREE - 0.1, 9);
  });

  it("brings north up by the heading", () => {
    fc.assert(
      fc.property(longitude, number(-89, 89), heading, number(-90, 60), (lon, lat, to, pitch) => {
        const pose = cameraAt(ecef(lon, lat, 100), to, pitch);
        const pivot = ecef(lon, lat, 0);
        const moved = orbit(pose, pivot, headingAt(pose, pivot), 0);
        expect(Math.abs(Math.sin(headingAt(moved, pivot)))).toBeLessThan(1e-6);
        expect(Math.cos(headingAt(moved, pivot))).toBeGreaterThan(0);
      }),
    );
  });
});

describe("dragging a place", () => {
  it("brings it under the pointer, over the ground at one height and tilt", () => {
    fc.assert(
      fc.property(
        fc.tuple(
          longitude,
          latitude,
          span.map((metres) => metres + 1),
        ),
        ...[heading, number(-90, -15), screen, screen],
        ([lon, lat, above], to, pitch, from, at) => {
          const pose = cameraAt(ecef(lon, lat, 200 + above), to, pitch);
          const place = meetSurface(rayThrough(pose, lens, from), 200);
          const wanted = meetSurface(rayThrough(pose, lens, at), 200);
          if (!place || !wanted || panWay(pose, place) !== "ground") return;
          const moved = panTo(pose, lens, place, at, "ground");
          const sine = -dot(rayThrough(pose, lens, at).direction, upAt(pose.position));
          // What is flatter than one in twenty is no place to drag the ground to.
          if (sine > 0.06) expect(stray(moved, place, at)).toBeLessThan(0.01);
          expect(defect(moved)).toBeLessThan(1e-12);
          if (above > 1e5) return;
          // The earth is not round: 5 mm of height in a move of 10 km.
          const far = distance(moved.position, pose.position) + distance(place, pose.position);
          expect(Math.abs(heightOf(moved.position) - heightOf(pose.position))).toBeLessThan(
            1e-6 + 2e-9 * far ** 2,
          );
          expect(Math.abs(pitchOf(moved, upAt(moved.position)) - pitch * DEGREE)).toBeLessThan(
            1e-9 * far + 1e-7,
          );
        },
      ),
      { numRuns: 300 },
    );
  });

  it("brings it under the pointer at its depth, from below and before a wall", () => {
    fc.assert(
      fc.property(sight, screen, ({ pose, place }, at) => {
        const moved = panTo(pose, lens, place, at, "picture");
        expect(stray(moved, place, at)).toBeLessThan(0.01);
        expect(turnBetween(moved, pose)).toBe(0);
        const depth = (from: CameraPose) => dot(difference(place, from.position), pose.direction);
        expect(Math.abs(depth(moved) - depth(pose))).toBeLessThan(1e-6);
      }),
    );
    const below = cameraAt(ecef(7, 50, -20), 30, 60);
    const place = alongRay(rayThrough(below, lens, { x: 300, y: 200 }), 40);
    expect(panWay(below, place)).toBe("picture");
    expect(
      stray(panTo(below, lens, place, { x: 500, y: 100 }, "ground"), place, { x: 500, y: 100 }),
    ).toBeLessThan(0.01);
  });

  it("does so without perspective", () => {
    fc.assert(
      fc.property(
        longitude,
        latitude,
        heading,
        number(-90, -20),
        screen,
        screen,
        (lon, lat, to, pitch, from, at) => {
          const pose = cameraAt(ecef(lon, lat, 5000), to, pitch);
          const wide = parallel(300);
          const place = meetSurface(rayThrough(pose, wide, from), 0)!;
          for (const way of ["ground", "picture"] as const) {
            expect(stray(panTo(pose, wide, place, at, way), place, at, wide)).toBeLessThan(0.01);
          }
          expect(stray(zoomAbout(pose, place, 0.5), place, from, parallel(150))).toBeLessThan(0.01);
        },
      ),
    );
  });

  it("goes on without a jump over the horizon and into the sky", () => {
    for (const above of [2, 100, 10_000, 1e6, 2e7]) {
      const pose = cameraAt(ecef(7, 51, above), 200, above > 1e5 ? -60 : -10);
      const place = meetSurface(rayThrough(pose, lens, { x: 400, y: 590 }), 0);
      if (!place) continue;
      let before: CameraPose | undefined;
      for (let y = 590; y > -300; y -= 0.25) {
        const moved = panTo(pose, lens, place, { x: 410, y }, "ground");
        expect(defect(moved)).toBeLessThan(1e-12);
        const far = Math.max(distance(place, moved.position), above);
        if (before)
          expect(distance(moved.position, before.position), `${above} m, ${y}`).toBeLessThan(0.1 * far);
        before = moved;
      }
    }
  });

  it("keeps the heading, away from the poles, and jumps at none", () => {
    const pose = cameraAt(ecef(10, 40, 1e6), 30, -70);
    const [from, to] = [ecef(10, 40), ecef(60, 65)];
    const moved = carried(pose, from, to);
    expect(headingAt(moved, to)).toBeCloseTo(headingAt(pose, from), 9);
    // In small steps across the pole, along a meridian and beside it.
    for (const beside of [0, 1e-9, 0.01, 3]) {
      let camera = cameraAt(ecef(beside, 70, 1000), 0, -50);
      const way = Array.from({ length: 401 }, (_, at) => {
        const lat = 70 + 0.1 * at;
        return lat <= 90 ? ecef(beside, lat) : ecef(beside + 180, 180 - lat);
      });
      for (let at = 1; at < way.length; at++) {
        const next = carried(camera, way[at - 1], way[at]);
        expect(defect(next)).toBeLessThan(1e-12);
        expect(turnBetween(next, camera), `beside ${beside}, ${at}`).toBeLessThan(0.03);
        expect(distance(next.position, camera.position)).toBeLessThan(60_000);
        camera = next;
      }
    }
  });
});

describe("zooming", () => {
  it("leaves the place where it is in the picture", () => {
    fc.assert(
      fc.property(sight, number(-3, 3), ({ pose, at, place }, power) => {
        const scale = 2 ** power;
        const moved = zoomAbout(pose, place, scale);
        expect(stray(moved, place, at)).toBeLessThan(0.01);
        expect(
          Math.abs(distance(moved.position, place) / distance(pose.position, place) / scale - 1),
        ).toBeLessThan(1e-7);
        expect(defect(moved)).toBeLessThan(1e-12);
      }),
    );
  });

  it("comes back to where it was", () => {
    fc.assert(
      fc.property(sight, number(-2, 0), ({ pose, place }, power) => {
        const back = zoomAbout(zoomAbout(pose, place, 2 ** power), place, 2 ** -power);
        const far = distance(pose.position, place);
        // Away from the horizon, below which the way back is straight.
        if (dot(difference(pose.position, place), upAt(place)) < 0.35 * far) return;
        expect(distance(back.position, pose.position)).toBeLessThan(1e-6 * far + 1e-6);
      }),
    );
  });

  it("arrives upright from space, wherever the place is in the picture", () => {
    fc.assert(
      fc.property(longitude, latitude, heading, screen, number(6, 7.3), (lon, lat, to, at, power) => {
        let pose = cameraAt(ecef(lon, lat, 10 ** power), to, -90);
        const place = meetSurface(rayThrough(pose, lens, at), 0);
        if (!place) return;
        const tilt = pitchOf(pose, upAt(pose.position));
        for (let turns = 0; turns < 200; turns++) {
          const next = zoomAbout(pose, place, 0.9);
          expect(turnBetween(next, pose)).toBeLessThan(0.5);
          pose = next;
        }
        expect(stray(pose, place, at)).toBeLessThan(0.01);
        expect(Math.abs(roll(pose))).toBeLessThan(0.01);
        expect(Math.abs(pitchOf(pose, upAt(pose.position)) - tilt)).toBeLessThan(0.01);
      }),
      { numRuns: 30 },
    );
  });

  it("goes away into space without losing the place", () => {
    const pose = cameraAt(ecef(8, 47, 700), 130, -35);
    const place = meetSurface(rayThrough(pose, lens, { x: 400, y: 300 }), 400)!;
    let away = pose;
    for (let turns = 0; turns < 110; turns++) {
      const next = zoomAbout(away, place, 1.1);
      expect(turnBetween(next, away)).toBeLessThan(0.1);
      away = next;
    }
    expect(stray(away, place, { x: 400, y: 300 })).toBeLessThan(0.01);
    expect(distance(away.position, place)).toBeGreaterThan(1e7);
    // And sees the earth from outside of it.
    expect(dot(difference(away.position, place), upAt(place))).toBeGreaterThan(0);
    expect(heightOf(away.position)).toBeGreaterThan(1e6);
  });
});

describe("walking", () => {
  it("keeps the height and the tilt", () => {
    fc.assert(
      fc.property(
        ...[longitude, latitude, number(-100, 5000), heading, number(-90, 90)],
        ...[number(-500, 500), number(-500, 500), number(-50, 50)],
        (lon, lat, height, to, pitch, ahead, aside, up) => {
          const pose = cameraAt(ecef(lon, lat, height), to, pitch);
          const moved = step(pose, { ahead, aside, up });
          expect(Math.abs(heightOf(moved.position) - height - up)).toBeLessThan(1e-6);
          expect(Math.abs(pitchOf(moved, upAt(moved.position)) - pitch * DEGREE)).toBeLessThan(1e-6);
          expect(Math.abs(roll(moved))).toBeLessThan(1e-6);
          expect(
            Math.abs(distance(moved.position, pose.position) - Math.hypot(ahead, aside, up)),
          ).toBeLessThan(0.3);
        },
      ),
    );
  });

  it("goes where the camera looks, straight down to where its picture's upper edge is", () => {
    const [down, level] = [-90, 0].map((pitch) => cameraAt(ecef(7, 50, 100), 90, pitch));
    for (const pose of [down, level]) {
      const { position } = step(pose, { ahead: 10, aside: 0, up: 0 });
      const [x, y, z] = difference(position, pose.position);
      const east = -Math.sin(7 * DEGREE) * x + Math.cos(7 * DEGREE) * y;
      expect(east).toBeCloseTo(10, 3);
      expect(z).toBeCloseTo(0, 3);
    }
  });

  it("goes across the poles without a jump", () => {
    for (const beside of [0, 1e-9, 1]) {
      let pose = cameraAt(ecef(beside, 89.99, 100), 0, -20);
      for (let steps = 0; steps < 500; steps++) {
        const next = step(pose, { ahead: 5, aside: 0, up: 0 });
        expect(turnBetween(next, pose)).toBeLessThan(1e-5);
        expect(distance(next.position, pose.position)).toBeLessThan(5.01);
        pose = next;
      }
      expect(Math.abs(heightOf(pose.position) - 100)).toBeLessThan(1e-5);
      // 1.1 km to the pole, the rest beyond it.
      expect(dot(difference(pose.position, ecef(beside, 90, 100)), ecef(beside, 0))).toBeLessThan(0);
    }
  });
});

it("stays a camera, whatever is done to it", () => {
  const deeds = fc.array(
    fc.tuple(fc.constantFrom("orbit", "pan", "zoom", "step"), number(-1, 1), number(-1, 1), screen),
    { minLength: 30, maxLength: 60 },
  );
  fc.assert(
    fc.property(longitude, latitude, heading, number(-90, 90), deeds, (lon, lat, to, pitch, all) => {
      let pose = cameraAt(ecef(lon, lat, 50), to, pitch);
      for (const [deed, a, b, at] of all) {
        const place = alongRay(rayThrough(pose, lens, at), 100);
        if (deed === "orbit") pose = orbit(pose, place, 3 * a, 3 * b, ALL_PITCHES);
        else if (deed === "pan")
          pose = panTo(pose, lens, place, { x: 400 + 400 * a, y: 300 + 300 * b }, panWay(pose, place));
        else if (deed === "zoom") pose = zoomAbout(pose, place, 2 ** a);
        else pose = step(pose, { ahead: 50 * a, aside: 50 * b, up: 0 });
        expect(defect(pose)).toBeLessThan(1e-11);
      }
    }),
  );
});

import { eastNorthUp, geodesicFrom, geodeticToEcef, turnOut, type Vector } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { groundAt } from "./ground-at.js";

const DEGREE = Math.PI / 180;

function ecef(longitude: number, latitude: number, height: number): Vector {
  const out = new Float64Array(3);
  geodeticToEcef(longitude, latitude, height, out);
  return [out[0]!, out[1]!, out[2]!];
}

/** A camera 100 m away from a place, which looks at it. @param tilt degrees below the horizon */
function lookingAt(place: Vector, heading: number, tilt: number) {
  const frame = eastNorthUp(place);
  const [h, t] = [heading * DEGREE, tilt * DEGREE];
  const turned = (level: number, rise: number) =>
    turnOut(frame, level * Math.sin(h), level * Math.cos(h), rise);
  const direction = turned(Math.cos(t), -Math.sin(t));
  const position: Vector = [0, 1, 2].map((axis) => place[axis]! - 100 * direction[axis]!) as never;
  return { position, direction, up: turned(Math.sin(t), Math.cos(t)) };
}

describe("the ground in the middle of a picture", () => {
  const [longitude, latitude] = [-123 * DEGREE, 44 * DEGREE];
  const place = ecef(longitude, latitude, 0);

  it.each([90, 60, 20])("has the scale of the geodesic across it, seen at %d°", (tilt) => {
    const pose = lookingAt(place, 40, tilt);
    const { metresPerPixel } = groundAt(pose, 100, 0.001)!;
    const end = geodesicFrom(longitude, latitude, 130 * DEGREE, 10);
    const [x, y, z] = ecef(end.longitude, end.latitude, 0).map((at, axis) => at - pose.position[axis]!);
    const { direction, up } = pose;
    const right = [
      direction[1]! * up[2]! - direction[2]! * up[1]!,
      direction[2]! * up[0]! - direction[0]! * up[2]!,
      direction[0]! * up[1]! - direction[1]! * up[0]!,
    ];
    const depth = x! * direction[0]! + y! * direction[1]! + z! * direction[2]!;
    const pixels = (x! * right[0]! + y! * right[1]! + z! * right[2]!) / depth / 0.001;
    expect(Math.abs((pixels * metresPerPixel) / 10 - 1)).toBeLessThan(1e-5);
  });

  it("has north where the camera's heading puts it", () => {
    for (const heading of [0, 30, 90, 179, -90]) {
      const { north } = groundAt(lookingAt(place, heading, 90), 100, 0.001)!;
      expect(Math.cos(north + heading * DEGREE)).toBeCloseTo(1, 9);
    }
  });

  it("has north flattened as the ground is", () => {
    // Of a view at 30° below the horizon, lengths ahead are half of those across.
    const { north } = groundAt(lookingAt(place, -45, 30), 100, 0.001)!;
    expect(Math.tan(north)).toBeCloseTo(2, 3);
  });

  it("is none above the horizon", () => {
    expect(groundAt(lookingAt(place, 0, 45), Number.NaN, 0.001)).toBeUndefined();
    expect(groundAt(lookingAt(place, 0, 45), Number.POSITIVE_INFINITY, 0.001)).toBeUndefined();
    expect(groundAt(lookingAt(place, 0, 45), -3, 0.001)).toBeUndefined();
  });
});

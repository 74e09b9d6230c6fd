import { geodesicBetween } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { placeVertex } from "../measure/index.js";
import { courseOf, wayOf } from "./course.js";

describe("long lines", () => {
  const place = (longitude: number, latitude: number, height = 0) =>
    placeVertex((longitude * Math.PI) / 180, (latitude * Math.PI) / 180, height);

  it("run along the geodesic, heights evenly between", () => {
    const [from, to] = [place(-70, 40, 100), place(140, 35, 300)];
    const course = courseOf(from, to);
    expect(course.length).toBe(127);
    const whole = geodesicBetween(from.longitude, from.latitude, to.longitude, to.latitude).distance;
    for (const [i, { longitude, latitude, height }] of course.entries()) {
      const share = (i + 1) / 128;
      const { distance } = geodesicBetween(from.longitude, from.latitude, longitude, latitude);
      expect(distance / whole).toBeCloseTo(share, 9);
      expect(height).toBeCloseTo(100 + 200 * share, 6);
    }
    // The shortest way between these leads by the north.
    expect(Math.max(...course.map(({ latitude }) => latitude))).toBeGreaterThan(1.1);
    expect(wayOf([from, to, from]).length).toBe(3 + 2 * 127);
    expect(courseOf(from, to)).toBe(course);
  });

  it("that are short are straight", () => {
    const short = [place(8, 47), place(8.001, 47), place(8.001, 47.001)];
    expect(wayOf(short)).toEqual(short);
    expect(courseOf(place(0, 0), place(0.04, 0))).toEqual([]);
    expect(courseOf(place(0, 0), place(0.05, 0)).length).toBe(1);
    expect(courseOf(place(0, 0), place(0, 0))).toEqual([]);
  });
});

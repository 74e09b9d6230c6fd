import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { random } from "../cartesian/points.fixture.js";
import { lookup } from "../crs/epsg-table.fixture.js";
import {
  anchorSimilarity,
  deriveTransformation,
  exactTransform,
  isOwnPlane,
  type MapPlane,
  pointTransform,
  resolveCrs,
  similarityTransform,
  sourceTransform,
  type Truth,
  truthOf,
  truthOnMap,
} from "../index.js";
import { encodeTransformation } from "../transformation/encode.js";

const MICROMETRE = 1e-6;
const BOX = { minX: 2600e3, minY: 1200e3, maxX: 2620e3, maxY: 1215e3 };
const crs = resolveCrs({ file: "scan", given: "EPSG:2056" }, lookup);

/** Greatest distance between a place and where its source coordinates lead. */
function worst(truth: Truth, box: typeof BOX, count = 200): number {
  const toSource = sourceTransform(truth, box, "scan");
  const there = pointTransform(truth);
  const next = random(11);
  const [place, source, back] = [0, 0, 0].map(() => new Float64Array(3));
  let greatest = 0;
  for (let i = 0; i < count; i++) {
    const [x, y] = [box.minX + next() * (box.maxX - box.minX), box.minY + next() * (box.maxY - box.minY)];
    there(x, y, 3000 * next(), place, 0);
    toSource(place[0], place[1], place[2], source);
    there(source[0], source[1], source[2], back, 0);
    greatest = Math.max(greatest, Math.hypot(...back.map((value, axis) => value - place[axis])));
  }
  return greatest;
}

const planeOf = (code: string): MapPlane => {
  const { proj4: definition } = resolveCrs({ file: code, given: code }, lookup);
  const common = { code, definition, metresPerUnit: 1, wraps: false, middle: 0.13 };
  return { ...common, own: isOwnPlane(crs, common, BOX) };
};

describe("sourceTransform", () => {
  const exact = exactTransform(crs, 500);

  it("undoes what proj4js does, in metres and in degrees", () => {
    expect(worst(exact, BOX)).toBeLessThan(MICROMETRE);
    const degrees = resolveCrs({ file: "scan", given: "EPSG:4326" }, lookup);
    const box = { minX: 7.4, minY: 46.9, maxX: 7.5, maxY: 47 };
    expect(worst(exactTransform(degrees), box)).toBeLessThan(MICROMETRE);
  });

  it("undoes a transformation, on the globe and in the planes of maps", async () => {
    const transformation = await deriveTransformation(crs, { ...BOX, minZ: 0, maxZ: 3000 });
    const truth = truthOf({ crs, transformation: encodeTransformation(transformation) }, 1500, "scan");
    expect(worst(truth, BOX)).toBeLessThan(MICROMETRE);
    for (const code of ["EPSG:3857", "EPSG:32632", "EPSG:2056"]) {
      const plane = planeOf(code);
      expect(plane.own).toBe(code === "EPSG:2056");
      for (const map of [truth, exact]) {
        expect(worst(truthOnMap(map, plane, 500, 1, "scan"), BOX)).toBeLessThan(MICROMETRE);
      }
    }
  });

  it("undoes a similarity far beyond the box of its points, and a box that is one point", () => {
    const similarity = similarityTransform(
      anchorSimilarity({
        ...{ longitude: 0.14, latitude: 0.81, height: 500, heading: 0.5, scale: 0.3048, at: [5, 6, 7] },
      }),
    );
    const toSource = sourceTransform(similarity, { minX: 1, minY: 2, maxX: 1, maxY: 2 }, "scan");
    const there = pointTransform(similarity);
    const [place, source] = [new Float64Array(3), new Float64Array(3)];
    fc.assert(
      fc.property(
        fc.tuple(...Array.from({ length: 3 }, () => fc.double({ min: -1e5, max: 1e5, noNaN: true }))),
        ([x, y, z]) => {
          there(x, y, z, place, 0);
          toSource(place[0], place[1], place[2], source);
          expect(Math.hypot(source[0] - x, source[1] - y, source[2] - z)).toBeLessThan(4 * MICROMETRE);
        },
      ),
    );
  });

  it("refuses what no coordinates lead to", () => {
    const toSource = sourceTransform(exact, BOX, "scan");
    expect(() => toSource(0, 0, 0, new Float64Array(3))).toThrow(
      expect.objectContaining({ code: "PLACE_DOMAIN", file: "scan" }),
    );
  });
});

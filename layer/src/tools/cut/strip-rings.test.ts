import fc from "fast-check";
import { expect, it } from "vitest";
import { PolygonVolume } from "../area/polygon-volume.js";
import { Corridor } from "../profile/corridor.js";
import { stripRings } from "./strip-rings.js";

const place = fc.tuple(fc.integer({ min: 0, max: 100 }), fc.integer({ min: 0, max: 100 }));
const line = fc.uniqueArray(place, { minLength: 2, maxLength: 6, selector: String });

it("rings cover the strip, and reach no farther than mitres do", () => {
  let [inside, outside] = [0, 0];
  fc.assert(
    fc.property(
      line,
      fc.integer({ min: 2, max: 60 }),
      fc.array(place, { minLength: 40, maxLength: 40 }),
      (vertices, width, points) => {
        const rings = stripRings(new Corridor(vertices, width)).map((ring) => new PolygonVolume([ring]));
        // Discs of sharp corners are polygons within the strip; mitres go a little beyond it.
        const [narrow, wide] = [new Corridor(vertices, 0.97 * width), new Corridor(vertices, 1.17 * width)];
        for (const [x, y] of points) {
          const [px, py] = [x + 0.137, y - 0.291];
          const covered = rings.some((ring) => ring.contains(px, py));
          if (narrow.contains(px, py)) {
            inside++;
            expect(covered).toBe(true);
          }
          // Ends are square: beyond them the wider strip is no longer either.
          if (covered && !wide.contains(px, py)) {
            const nearEnd = [vertices[0], vertices[vertices.length - 1]].some(
              ([ex, ey]) => Math.hypot(px - ex, py - ey) < 1.2 * width,
            );
            expect(nearEnd).toBe(true);
          }
          if (!covered) outside++;
        }
      },
    ),
    { numRuns: 150 },
  );
  expect(inside).toBeGreaterThan(500);
  expect(outside).toBeGreaterThan(500);
});

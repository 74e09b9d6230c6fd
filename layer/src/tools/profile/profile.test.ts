import { PlacementError } from "@groma/georef";
import { describe, expect, it } from "vitest";
import type { PointBatch } from "../../query/index.js";
import { geodesicLengths, Profile, type ProfiledCloud } from "./profile.js";

const FOOT = 0.3048;

/** A data set in feet whose map is so plain that longitude and latitude follow x and y. */
function cloudOf(kind: "linear" | "angular" = "linear"): ProfiledCloud {
  const radius = 6_378_137;
  const records = { count: 3, xyz: Int32Array.of(10, 2, 100, 50, -1, 200, 90, 40, 300), attributes: [] };
  return {
    name: "scan",
    scale: [1, 1, 0.5],
    offset: [0, 0, 0],
    boundingBox: { min: [0, -50, 0], max: [100, 50, 0] },
    crs: { horizontalUnit: { kind, size: FOOT }, verticalUnit: { size: FOOT } } as never,
    place(x, y, _z, out) {
      const [longitude, latitude] = [(x * FOOT) / radius, (y * FOOT) / radius];
      out[0] = radius * Math.cos(latitude) * Math.cos(longitude);
      out[1] = radius * Math.cos(latitude) * Math.sin(longitude);
      out[2] = radius * Math.sin(latitude);
      return out;
    },
    query: ({ volume } = {}) =>
      ({
        async *batches() {
          const inside = [0, 1, 2].filter((point) =>
            volume!.contains(records.xyz[3 * point], records.xyz[3 * point + 1], 0),
          );
          yield { node: "0-0-0-0", records, inside: Uint32Array.from(inside) } as unknown as PointBatch;
        },
      }) as never,
    lasEnvelope: async () => undefined,
  };
}

const radians = (x: number) => (x * FOOT) / 6_378_137;

describe("a profile", () => {
  it("gives chainage, offset and height of its points in metres", async () => {
    const profile = new Profile(cloudOf(), {
      line: [
        [0, 0],
        [radians(100), 0],
      ],
      width: 10 * FOOT,
    });
    expect(profile.length).toBeCloseTo(100 * FOOT, 6);
    expect(profile.volume.reach).toBeCloseTo(5, 9);
    const { value: points } = await profile.points().next();
    if (!points) throw new Error("the profile has no points");
    expect([...points.batch.inside]).toEqual([0, 1]);
    const expected = { chainage: [10, 50], offset: [2, -1], height: [50, 100] };
    for (const [name, values] of Object.entries(expected)) {
      const found = points[name as keyof typeof expected];
      for (const [index, feet] of values.entries()) expect(found[index]).toBeCloseTo(feet * FOOT, 5);
    }
  });

  it("counts chainage along geodesics, from a start", async () => {
    const line = [
      [0, 0],
      [radians(100), 0],
    ] as const;
    const profile = new Profile(cloudOf(), { line, width: 10 * FOOT, chainage: "geodesic", start: 1000 });
    // The cloud lies on a sphere of the equator's radius, along which both lengths are the same.
    const { value } = await profile.points().next();
    expect(value!.chainage[1]).toBeCloseTo(1000 + 50 * FOOT, 5);
    expect(profile.length).toBeCloseTo(100 * FOOT, 6);
    const north = [
      [0, 0],
      [0, Math.PI / 4],
    ] as const;
    expect(geodesicLengths(north)[0]).toBeCloseTo(4984944.378, 2);
  });

  it("refuses coordinates that are angles, and lines without length", () => {
    const line = [
      [0, 0],
      [radians(50), 0],
    ] as const;
    const codeOf = (make: () => Profile) => {
      try {
        make();
      } catch (thrown) {
        expect(thrown).toBeInstanceOf(PlacementError);
        return (thrown as PlacementError).code;
      }
      return undefined;
    };
    expect(codeOf(() => new Profile(cloudOf("angular"), { line, width: 1 }))).toBe("PLACE_ANGLES");
    expect(codeOf(() => new Profile(cloudOf(), { line: [line[0], line[0]], width: 1 }))).toBe("PLACE_LINE");
    expect(codeOf(() => new Profile(cloudOf(), { line, width: 0 }))).toBe("PLACE_LINE");
    expect(codeOf(() => new Profile(cloudOf(), { line, width: 1 }))).toBeUndefined();
  });
});

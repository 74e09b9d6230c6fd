import { geodeticToEcef, PlacementError } from "@groma/georef";
import { describe, expect, it } from "vitest";
import type { PointBatch } from "../../query/index.js";
import { CrossSections } from "../sections/cross-sections.js";
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
    expect(profile.strip.reach).toBeCloseTo(5, 9);
    const { value: points } = await profile.points().next();
    if (!points) throw new Error("the profile has no points");
    expect([...points.batch.inside]).toEqual([0, 1]);
    const expected = { chainage: [10, 50], offset: [2, -1], height: [50, 100] };
    for (const [name, values] of Object.entries(expected)) {
      const found = points[name as keyof typeof expected];
      for (const [index, feet] of values.entries()) expect(found[index]).toBeCloseTo(feet * FOOT, 5);
    }
  });

  it("comes in parts, each point once, and lets others have the thread in between", async () => {
    const count = 120_000;
    const xyz = new Int32Array(3 * count);
    for (let point = 0; point < count; point++) xyz[3 * point] = point % 90;
    const everything = Uint32Array.from({ length: count }, (_, point) => point);
    const cloud: ProfiledCloud = {
      ...cloudOf(),
      query: () =>
        ({
          async *batches() {
            yield { node: "0-0-0-0", records: { count, xyz, attributes: [] }, inside: everything };
          },
        }) as never,
    };
    const line = Array.from({ length: 60 }, (_, vertex) => [radians(2 * vertex), 0] as const);
    let turns = 0;
    const others = setInterval(() => turns++);
    let seen = 0;
    for await (const { batch, chainage } of new Profile(cloud, { line, width: 4 }).points()) {
      expect(chainage.length).toBe(batch.inside.length);
      expect(chainage.length).toBeLessThanOrEqual(16_384);
      expect(batch.inside[0]).toBe(seen);
      seen += batch.inside.length;
    }
    clearInterval(others);
    expect(seen).toBe(count);
    expect(turns).toBeGreaterThan(1);
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

  it("is decided in metres on the ellipsoid where coordinates are angles, sections too", async () => {
    const DEGREE = Math.PI / 180;
    const east = (metres: number) => metres / (111_320 * Math.cos(47 * DEGREE));
    // Points 10 m apart along the parallel, every second one 3 m to the north.
    const count = 40;
    const scale = 1e-8;
    const xyz = new Int32Array(3 * count);
    for (let point = 0; point < count; point++) {
      const north = point % 2 === 0 ? 0 : 3 / 111_170;
      xyz.set([Math.round(east(10 * point) / scale), Math.round(north / scale), 100 + point], 3 * point);
    }
    const cloud: ProfiledCloud = {
      ...cloudOf("angular"),
      ...{ scale: [scale, scale, 1], offset: [7, 47, 0] },
      crs: { horizontalUnit: { kind: "angular", size: DEGREE }, verticalUnit: { size: 1 } } as never,
      boundingBox: { min: [6.99, 46.99, 0], max: [7.02, 47.01, 1000] },
      place: (x, y, z, out) => {
        geodeticToEcef(x * DEGREE, y * DEGREE, z, out);
        return out;
      },
      query: ({ volume } = {}) =>
        ({
          async *batches() {
            const inside = Array.from({ length: count }, (_, point) => point).filter((point) =>
              volume!.contains(
                xyz[3 * point] * scale + 7,
                xyz[3 * point + 1] * scale + 47,
                xyz[3 * point + 2],
              ),
            );
            const records = { count, xyz, attributes: [] };
            yield { node: "0-0-0-0", records, inside: Uint32Array.from(inside) } as unknown as PointBatch;
          },
        }) as never,
    };
    const line = [
      [(7 - east(1)) * DEGREE, 47 * DEGREE],
      [(7 + east(201)) * DEGREE, 47 * DEGREE],
    ] as const;
    const profile = new Profile(cloud, { line, width: 4, start: 49 });
    expect(profile.unit).toBe(1);
    expect(profile.length).toBeCloseTo(202, 0);
    const { value: points } = await profile.points().next();
    // Those on the line alone: 0, 20, … 200 m.
    expect([...points!.batch.inside]).toEqual(Array.from({ length: 11 }, (_, index) => 2 * index));
    for (const [index, chainage] of points!.chainage.entries())
      expect(Math.abs(chainage - 50 - 20 * index)).toBeLessThan(0.5);
    const wider = await new Profile(cloud, { line, width: 7 }).points().next();
    expect([...wider.value!.offset].filter((offset) => offset > 2.9)).toHaveLength(10);
    const sections = profile.across(
      new CrossSections(profile.strip, [100], { left: 5, right: 5, thickness: 1 }),
    );
    // 50 m from the start: the sixth point, 3 m to the north, and so to the left.
    const place = new Float64Array(2);
    sections.sections[0].strip.locate(7 + east(50), 47 + 3 / 111_170, place, 105);
    expect(place[0]).toBeCloseTo(-3, 1);
    const [ecef, there] = [new Float64Array(3), new Float64Array(3)];
    profile.toPlane(7.001, 47.0001, 10, place);
    profile.place(place[0], place[1], 10, ecef);
    cloud.place(7.001, 47.0001, 10, there);
    for (const axis of [0, 1, 2]) expect(ecef[axis]).toBeCloseTo(there[axis], 5);
  });

  it("refuses the plane of coordinates that are angles, and lines without length", () => {
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
    const source = { line, width: 1, plane: "source" } as const;
    expect(codeOf(() => new Profile(cloudOf("angular"), source))).toBe("PLACE_ANGLES");
    expect(codeOf(() => new Profile(cloudOf(), { line: [line[0], line[0]], width: 1 }))).toBe("PLACE_LINE");
    expect(codeOf(() => new Profile(cloudOf(), { line, width: 0 }))).toBe("PLACE_LINE");
    expect(codeOf(() => new Profile(cloudOf(), { line, width: 1 }))).toBeUndefined();
  });
});

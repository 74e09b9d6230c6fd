import { describe, expect, it } from "vitest";
import { cloudOf, type FixtureCloud, PLACE, type Points, UTM, withPoints } from "../cloud.fixture.js";
import { measureHeightAboveGround, measureVolume } from "../index.js";

const [X, Y] = PLACE;

/** Ground that falls by a tenth to the east, with trees of class 5 on it. */
const slope: Points = Array.from({ length: 400 }, (_, i) => {
  const [x, y] = [(i % 20) - 10, Math.floor(i / 20) - 10];
  return i % 7 === 0 ? ([x, y, 20, 5] as const) : ([x + 0.3, y, 5 - 0.1 * (x + 0.3), 2] as const);
});

describe("the height above the ground", () => {
  it("is that above the plane of the ground around, whatever stands on it", async () => {
    const cloud = withPoints(cloudOf(UTM), slope);
    const top = cloud.vertex(X + 1, Y + 1, 17);
    const height = await measureHeightAboveGround(cloud, top, { precision: 0.01 });
    expect(height.value).toBeCloseTo(17 - 4.9, 3);
    expect(height.uncertainty).toBeGreaterThan(0.019);
    expect(height.uncertainty).toBeLessThan(0.03);
    expect(height.parts.map(({ name }) => name)).toContain("ground");
  });

  it("is worth less where the ground is rough", async () => {
    const rough = slope.map(([x, y, z, kind], i) => [x, y, z + 0.2 * ((i % 3) - 1), kind] as const);
    const cloud = withPoints(cloudOf(UTM), rough);
    const height = await measureHeightAboveGround(cloud, cloud.vertex(X, Y, 9), { precision: 0.01 });
    expect(height.uncertainty).toBeGreaterThan(0.25);
  });

  it("is that above the ground farther away where a roof hides what is near", async () => {
    // A long roof, with rough ground on three sides of it.
    const yard: Points = Array.from({ length: 1600 }, (_, i) => {
      const [x, y] = [(i % 40) - 20, Math.floor(i / 40) - 20];
      const roof = x > -6 && Math.abs(y) < 6;
      return roof ? ([x, y, 12, 6] as const) : ([x, y, 5 + 0.05 * ((i % 3) - 1), 2] as const);
    });
    const cloud = withPoints(cloudOf(UTM), yard);
    const near = (count: number) => yard.filter(([x, y, , kind]) => kind === 2 && Math.hypot(x, y) < count);
    expect([near(5.9).length, near(9).length > 0]).toEqual([0, true]);
    const height = await measureHeightAboveGround(cloud, cloud.vertex(X, Y, 12), { precision: 0.01 });
    expect(Math.abs(height.value - 7)).toBeLessThan(height.uncertainty!);
    expect(height.parts[0]).toMatchObject({ name: "ground", note: expect.stringContaining("within 9 m") });
    await expect(
      measureHeightAboveGround(cloud, cloud.vertex(X, Y, 12), { radius: 3 }),
    ).rejects.toMatchObject({ code: "MEASURE_GROUND" });
  });

  it("is none where there is no ground, or another data set", async () => {
    const cloud = withPoints(cloudOf(UTM), slope);
    const top = cloud.vertex(X, Y, 17);
    await expect(measureHeightAboveGround(cloud, top, { radius: 0.5 })).rejects.toMatchObject({
      code: "MEASURE_GROUND",
    });
    await expect(measureHeightAboveGround(cloud, top, { classes: new Set([9]) })).rejects.toThrow(
      "MEASURE_GROUND",
    );
    await expect(measureHeightAboveGround(cloud, cloudOf(UTM).vertex(X, Y, 1))).rejects.toThrow(
      "MEASURE_DATASET",
    );
  });
});

/** A data set with no place beside its points, as one whose grid of shifts ends there. */
function fenced(points: Points) {
  const cloud = withPoints(cloudOf(UTM), points);
  const place = cloud.place.bind(cloud);
  return Object.assign(cloud, {
    place(x: number, y: number, z: number) {
      if (Math.max(Math.abs(x - X), Math.abs(y - Y)) > 10.2) throw new Error("no place");
      return place(x, y, z);
    },
  });
}

describe("at the edge of a data set", () => {
  it("heights and volumes ask for no place beside it", async () => {
    const cloud = fenced(slope);
    const height = await measureHeightAboveGround(cloud, cloud.vertex(X + 10, Y + 9, 17));
    expect(height.value).toBeCloseTo(17 - 4, 3);
    const ring = [
      [-10, -10],
      [10, -10],
      [10, 10],
    ].map(([x, y]) => cloud.vertex(X + x!, Y + y!, 0));
    expect((await measureVolume(cloud, ring)).area).toBeCloseTo(200 / 0.9996 ** 2, 3);
  });
});

describe("the volume of a data set", () => {
  const pile: Points = Array.from({ length: 6400 }, (_, i) => {
    const [x, y] = [(i % 80) / 4 - 10, Math.floor(i / 80) / 4 - 10];
    return [x, y, Math.max(0, 4 - Math.hypot(x, y)), 2] as const;
  });
  const ringOf = (cloud: FixtureCloud) =>
    [
      [-8, -8],
      [8, -8],
      [8, 8],
      [-8, 8],
    ].map(([x, y]) => cloud.vertex(X + x!, Y + y!, 0));

  it("is one of the ground, not of the grid, and holds the truth", async () => {
    const cloud = withPoints(cloudOf(UTM), pile);
    const { cut, fill, net, area, covered, points } = await measureVolume(cloud, ringOf(cloud), {
      precision: 0.01,
    });
    const truth = (Math.PI * 64) / 3 / 0.9996 ** 2;
    expect(Math.abs(cut.value / truth - 1)).toBeLessThan(2e-3);
    expect(Math.abs(cut.value - truth)).toBeLessThan(cut.uncertainty!);
    expect(fill.value).toBeCloseTo(0, 6);
    expect(net.value).toBe(cut.value - fill.value);
    expect(area).toBeCloseTo(256 / 0.9996 ** 2, 3);
    expect(covered).toBeCloseTo(area, 6);
    expect(points).toBeGreaterThan(4096);
  });

  it("is refused where an option is none, and takes classes as they are saved", async () => {
    const cloud = withPoints(cloudOf(UTM), pile);
    for (const options of [
      { base: { kind: "height", height: Number.NaN } },
      { base: { kind: "height", height: "5" } },
      { base: { kind: "mean" } },
      { base: { kind: "cloud" } },
      { bsae: 1 },
      { classes: 2 },
      { precision: -1 },
    ]) {
      await expect(measureVolume(cloud, ringOf(cloud), options as never)).rejects.toMatchObject({
        code: "MEASURE_OPTION",
      });
    }
    for (const radius of [-2, Number.NaN, 0]) {
      await expect(measureHeightAboveGround(cloud, cloud.vertex(X, Y, 5), { radius })).rejects.toMatchObject({
        code: "MEASURE_OPTION",
      });
    }
    const [listed, set] = await Promise.all(
      [[2], new Set([2])].map((classes) => measureVolume(cloud, ringOf(cloud), { classes })),
    );
    expect(listed!.cut.value).toBe(set!.cut.value);
  });

  it("is worth what is not known where the scan has a gap", async () => {
    const holed = withPoints(
      cloudOf(UTM),
      pile.filter(([x, y]) => Math.hypot(x + 3, y) > 3),
    );
    const { cut, covered, area } = await measureVolume(holed, ringOf(holed), { precision: 0.01 });
    expect(covered).toBeLessThan(area - 20);
    expect(cut.uncertainty).toBeNull();
    expect(cut.parts[0]).toMatchObject({ name: "gaps", note: expect.stringContaining("% of the polygon") });
  });

  it("changes between two data sets by what one has and the other lacks, with its level of detection", async () => {
    const parts = [
      { name: "datum operation", metres: 0.02 },
      { name: "height", metres: 0 },
    ];
    const made = (name: string, points: Points) => withPoints(cloudOf(UTM, { name, parts }), points);
    const after = made("after", pile);
    const before = made(
      "before",
      pile.map(([x, y, z, kind]) => [x + 0.1, y - 0.1, z / 2, kind] as const),
    );
    const base = { kind: "cloud", cloud: before } as const;
    const { cut, levelOfDetection } = await measureVolume(after, ringOf(after), { base, precision: 0.01 });
    expect(Math.abs(cut.value / ((Math.PI * 64) / 6) - 1)).toBeLessThan(0.02);
    expect(levelOfDetection).toBeCloseTo(1.96 * Math.hypot(0.01, 0.02, 0.01, 0.02), 6);
    expect(cut.parts.map(({ name }) => name)).toContain("place of both data sets");
    const unknown = await measureVolume(after, ringOf(after), { base });
    expect([unknown.levelOfDetection, unknown.cut.uncertainty]).toEqual([null, null]);
    const other = withPoints(cloudOf(UTM.replace("32", "33"), { name: "other" }), pile);
    await expect(
      measureVolume(after, ringOf(after), { base: { kind: "cloud", cloud: other } }),
    ).rejects.toMatchObject({ code: "MEASURE_DATASET" });
  });
});

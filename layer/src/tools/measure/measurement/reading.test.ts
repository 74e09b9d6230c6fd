import { describe, expect, it, vi } from "vitest";
import { cloudOf, PLACE, type Points, UTM, withPoints } from "../cloud.fixture.js";
import {
  type Measurement,
  measureHeightAboveTerrain,
  placeVertex,
  readValues,
  sourceVertex,
  type Terrain,
  type Vertex,
} from "../index.js";
import { type Reading, Readings } from "./reading.js";

const [X, Y] = PLACE;

/** Ground at 5 m with a heap, two metres high, of another class. */
const heap: Points = Array.from({ length: 900 }, (_, i) => {
  const [x, y] = [(i % 30) - 15, Math.floor(i / 30) - 15];
  return Math.hypot(x, y) < 4 ? ([x, y, 7, 1] as const) : ([x, y, 5, 2] as const);
});
const cloud = withPoints(cloudOf(UTM), heap);
const ring = (
  [
    [-10, -10],
    [10, -10],
    [10, 10],
    [-10, 10],
  ] as const
).map(([x, y]) => cloud.vertex(X + x, Y + y, 5));
const volume = (changes: Partial<Measurement> = {}): Measurement => ({
  ...{ id: "1", kind: "volume", name: "Volume 1", vertices: ring, ...changes },
});
const above = (vertex: Vertex): Measurement => ({
  ...{ id: "2", kind: "aboveGround", name: "Above ground 1", vertices: [vertex] },
});
const byName = async (measurement: Measurement, options = {}) =>
  new Map((await readValues(measurement, options)).map(({ name, quantity }) => [name, quantity]));

/** An elevation model of one height. */
const flat = (height: number | undefined, precision?: number): Terrain => ({
  ...{ name: "flat", precision, heightAt: async () => height },
});

describe("values that take reading points", () => {
  it("are those of the volume as it is set", async () => {
    const values = await byName(volume());
    expect([...values.keys()]).toEqual(["net", "cut", "fill", "covered"]);
    const net = values.get("net")!.value;
    // 49 points of the heap stand for about a square metre each.
    expect(net).toBeGreaterThan(90);
    expect(net).toBeLessThan(130);
    expect(values.get("covered")!.value).toBeCloseTo(1, 6);
    const bare = await byName(volume({ volume: { classes: [2] } }));
    expect(bare.get("net")!.value).toBeCloseTo(0, 6);
    const deep = await byName(volume({ volume: { base: { kind: "height", height: 4 } } }));
    expect(deep.get("net")!.value).toBeCloseTo(net + 400, -1);
  });

  it("are the change against another data set, that has to be open", async () => {
    const before = withPoints(
      cloudOf(UTM, { name: "before" }),
      heap.map(([x, y, , kind]) => [x, y, 5, kind] as const),
    );
    const against = volume({ volume: { base: { kind: "cloud", dataset: "before" } } });
    const changed = (await byName(against, { clouds: [cloud, before] })).get("net")!.value;
    expect(changed).toBeCloseTo((await byName(volume())).get("net")!.value, 6);
    await expect(readValues(against)).rejects.toMatchObject({ code: "MEASURE_DATASET", file: "before" });
  });

  it("are the change against another data set of the same name", async () => {
    const of = (identity: string, points: Points) =>
      Object.assign(withPoints(cloudOf(UTM, { name: "scan" }), points), { identity });
    const after = of("900-aaaaaaaa", heap);
    const before = of(
      "900-bbbbbbbb",
      heap.map(([x, y, , kind]) => [x, y, 5, kind] as const),
    );
    const vertices = ring.map(({ source }) => after.vertex(...source!));
    const against = (identity: string) =>
      volume({ vertices, volume: { base: { kind: "cloud", dataset: "scan", identity } } });
    const clouds = [after, before];
    const changed = (await byName(against("900-bbbbbbbb"), { clouds })).get("net")!.value;
    expect(changed).toBeCloseTo((await byName(volume())).get("net")!.value, 6);
    // Against itself nothing has changed, and of that there is no doubt.
    const none = await byName(against("900-aaaaaaaa"), { clouds });
    for (const name of ["net", "cut", "fill", "levelOfDetection"]) {
      expect([name, none.get(name)!.value, none.get(name)!.uncertainty]).toEqual([name, 0, 0]);
    }
    await expect(readValues(against("900-bbbbbbbb"), { clouds: [after] })).rejects.toMatchObject({
      code: "MEASURE_DATASET",
      message: expect.stringContaining("has other points than the one that was measured"),
    });
  });

  it("are worth no more than the vertices that they are measured against", async () => {
    const parts = async (kind: "lowest" | "height", vertices = ring) => {
      const base = kind === "height" ? { kind, height: 5 } : { kind };
      const values = await byName(volume({ vertices, volume: { base } }), { precision: 0.01 });
      const { parts: all, value: net } = values.get("net")!;
      return { net, standard: new Map(all.map((one) => [one.name, one.standard])) };
    };
    const lowest = await parts("lowest");
    const level = await parts("height");
    expect(lowest.net).toBeCloseTo(level.net, 6);
    // One vertex bears 400 m²; the 400 points of the surface a square metre each, and the slopes of the heap besides.
    expect(lowest.standard.get("point precision")).toBeGreaterThan(0.01 * 400);
    expect(level.standard.get("point precision")).toBeGreaterThan(0.01 * 20);
    expect(level.standard.get("point precision")).toBeLessThan(0.01 * 50);
    // What an edge is worth that is no record nobody knows.
    const free = ring.map(({ source }) => sourceVertex(cloud, source!));
    expect((await parts("lowest", free)).standard.get("place")).toBeNull();
  });

  it("are heights above the ground, the terrain's too where there is one", async () => {
    const vertex = cloud.vertex(X + 3, Y, 7);
    const values = await byName(above(vertex), { terrain: flat(vertex.height - 3, 0.5), precision: 0.01 });
    expect(values.get("aboveGround")!.value).toBeCloseTo(2, 3);
    expect(values.get("aboveTerrain")!.value).toBeCloseTo(3, 6);
    // A terrain without a height leaves the ground's.
    expect([...(await byName(above(vertex), { terrain: flat(undefined) })).keys()]).toEqual(["aboveGround"]);
    await expect(readValues(above(placeVertex(0, 0, 0)))).rejects.toMatchObject({ code: "MEASURE_DATASET" });
  });

  it("know what a terrain is worth, and that a place without it has none", async () => {
    const vertex = placeVertex(0.1, 0.8, 510);
    const height = await measureHeightAboveTerrain(vertex, flat(500, 2));
    expect(height.value).toBeCloseTo(10, 9);
    expect(height.parts.find(({ name }) => name === "terrain")?.standard).toBe(2);
    expect((await measureHeightAboveTerrain(vertex, flat(500))).uncertainty).toBeNull();
    for (const none of [undefined, Number.NaN]) {
      await expect(measureHeightAboveTerrain(vertex, flat(none))).rejects.toMatchObject({
        code: "MEASURE_TERRAIN",
        file: "flat",
      });
    }
  });
});

describe("readings of several measurements", () => {
  const settled = (readings: Readings, of: Measurement) =>
    vi.waitFor(() => {
      const reading = readings.of(of);
      if (!reading || reading.state === "reading") throw new Error("not yet");
      return reading;
    });

  it("are kept as long as the measurement is the same, and go one after the other", async () => {
    const [one, other] = [volume(), above(cloud.vertex(X + 3, Y, 7))];
    const seen: string[] = [];
    const readings: Readings = new Readings(
      () => ({ precision: 0.01 }),
      () => seen.push([one, other].map((each) => readings.of(each)?.state.slice(0, 1)).join("")),
    );
    const plain: Measurement = { ...one, id: "3", kind: "area" };
    readings.follow([one, other, plain]);
    expect([one, other, plain].map((each) => readings.of(each)?.state)).toEqual([
      "reading",
      "reading",
      undefined,
    ]);
    const done = await settled(readings, other);
    expect(done.state).toBe("done");
    expect(seen.at(-1)).toBe("dd");
    expect(seen).not.toContain("rd");
    readings.follow([one, other]);
    expect(readings.of(other)).toBe(done);
    // Another vertex makes another measurement of it.
    const moved = { ...one, vertices: [...ring.slice(0, 3), cloud.vertex(X - 9, Y + 9, 5)] };
    readings.follow([moved, other]);
    expect(readings.of(moved)?.state).toBe("reading");
    expect((await settled(readings, moved)).state).toBe("done");
    expect(readings.of(one)?.state).toBe("done");
  });

  it("stop when they are told to or nobody wants them, and are read again", async () => {
    const [one, other] = [volume(), above(cloud.vertex(X + 3, Y, 7))];
    const readings = new Readings(
      () => ({}),
      () => undefined,
    );
    readings.follow([one, other]);
    readings.stop(one);
    expect(readings.of(one)).toEqual({ state: "stopped" });
    expect((await settled(readings, other)).state).toBe("done");
    expect(readings.of(one)).toEqual({ state: "stopped" });
    readings.again([one]);
    expect((await settled(readings, one)).state).toBe("done");
    readings.again([one, other]);
    readings.destroy();
    expect(readings.of(one)).toBeUndefined();
    expect(readings.of(other)).toBeUndefined();
  });

  it("tell what keeps them from a value", async () => {
    const lost = volume({ vertices: ring.map((vertex) => ({ ...vertex, cloud: undefined })) });
    const readings = new Readings(
      () => ({}),
      () => undefined,
    );
    readings.follow([lost]);
    const reading = (await settled(readings, lost)) as Extract<Reading, { state: "failed" }>;
    expect(reading.thrown).toMatchObject({ code: "MEASURE_DATASET", file: "scan" });
  });
});

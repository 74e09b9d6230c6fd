import { ecefToGeodetic, encodeRecord, exactTransform } from "@groma/georef";
import { describe, expect, it } from "vitest";
import type { View } from "../octree/index.js";
import type { TinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import type { NodeJob } from "../workers/index.js";
import { transformationBytes } from "../workers/transformation.fixture.js";
import { loadProjections } from "./map-octrees.js";
import { crs, open, record, twoNodes, UTM, withRecord } from "./opened-cloud.fixture.js";
import { PointCloud } from "./point-cloud.js";

describe("PointCloud", () => {
  it("starts its worker before the file answers, and ends it where the file cannot be opened", async () => {
    const workers: { terminated: boolean }[] = [];
    const createWorker = () => {
      const worker = { terminated: false, postMessage() {}, terminate: () => (worker.terminated = true) };
      workers.push(worker);
      return { ...worker, onmessage: null, onerror: null, onmessageerror: null };
    };
    const opening = PointCloud.fromUrl(new Blob([new Uint8Array(600)]), { workers: { createWorker } });
    expect(workers).toHaveLength(1);
    await expect(opening).rejects.toThrow(expect.objectContaining({ code: "FORMAT_MAGIC" }));
    expect(workers).toEqual([expect.objectContaining({ terminated: true })]);
  });

  it("goes by Groma's own record", async () => {
    const { cloud, executor } = await open(withRecord);
    expect([cloud.basis, cloud.crs.name, cloud.height.kind]).toEqual(["record", "recorded", "ellipsoidal"]);
    expect(cloud.accuracy.total).toBeCloseTo(0.006, 12);
    expect(executor.specs[0]).toMatchObject({ crs: { verticalUnit: { size: 0.3048 } }, heights: [0, 50] });
  });

  it("lets the application overrule it, and says so", async () => {
    const { cloud } = await open(withRecord, { crs: UTM, tolerance: 0.01 });
    expect([cloud.basis, cloud.height.kind, cloud.accuracy.total]).toEqual(["given", "ellipsoidal", null]);
    const fit = cloud.accuracy.parts.find((part) => part.name === "fit");
    const datum = cloud.accuracy.parts.find((part) => part.name === "datum operation");
    expect([fit?.metres, datum?.note]).toEqual([0.01, expect.stringContaining("given by the user")]);
  });

  it("hands the worker the transformation in the file, and places single points by it", async () => {
    const third = await transformationBytes(crs, { minX: 0, minY: 0, maxX: 100, maxY: 100 }, 40);
    const records: TinyCopc["records"] = [
      ["groma", 1, encodeRecord({ ...record, crs, engine: { name: "PROJ", version: "9.5.0" } })],
      ["groma", 3, third],
    ];
    const { cloud, executor } = await open({ records });
    expect(executor.specs[0].transformation).toEqual(third);
    const { cloud: flat } = await open({}, { crs: UTM, vertical: "ellipsoidal" });
    const [at, below] = [cloud.place(50, 60, 7), flat.place(50, 60, 47)];
    expect(Math.hypot(at[0] - below[0], at[1] - below[1], at[2] - below[2])).toBeLessThan(1e-4);
    expect([cloud.engine.name, cloud.geoids, flat.engine.name, flat.geoids]).toEqual([
      ...["PROJ", ["flat.tif"]],
      ...["proj4js", []],
    ]);
    const { bounds } = cloud;
    expect(Math.hypot(at[0] - bounds.x, at[1] - bounds.y, at[2] - bounds.z)).toBeLessThan(bounds.radius);
    expect(() => cloud.place(-1, 0, 0)).toThrow(expect.objectContaining({ code: "PLACE_DOMAIN" }));
  });

  it("gives the source coordinates of places in space, on the ellipsoid and on maps", async () => {
    const third = await transformationBytes(crs, { minX: 0, minY: 0, maxX: 100, maxY: 100 }, 40);
    const engine = { name: "PROJ", version: "9.5.0" } as const;
    const records: TinyCopc["records"] = [
      ["groma", 1, encodeRecord({ ...record, crs, engine })],
      ["groma", 3, third],
    ];
    const { cloud: carried } = await open({ records });
    const { cloud: derived } = await open({}, { crs: UTM, vertical: "ellipsoidal" });
    const point = [50.125, 60.25, 7] as const;
    const feet = {
      code: "feet",
      definition: `${UTM.replace("+units=m", "+units=ft")} +no_defs`,
      ...{ metresPerUnit: 0.3048, wraps: false },
    };
    await loadProjections();
    for (const cloud of [carried, derived]) {
      const [x, y, z] = cloud.place(...point);
      const geodetic = new Float64Array(3);
      ecefToGeodetic(x, y, z, geodetic);
      const [longitude, latitude, height] = geodetic;
      const found = [
        cloud.sourceOf([x, y, z]),
        cloud.sourceOf([longitude, latitude, height], "geodetic"),
        cloud.sourceOf([point[0] / 0.3048, point[1] / 0.3048, height], feet),
      ];
      for (const source of found) {
        expect(Math.max(...point.map((value, axis) => Math.abs(source[axis] - value)))).toBeLessThan(1e-6);
      }
    }
    expect(() => carried.sourceOf([0, 6.4e6, 0])).toThrow(expect.objectContaining({ code: "PLACE_DOMAIN" }));
  });

  it("PLACE_DOMAIN where the transformation covers other places than the file's box", async () => {
    const third = await transformationBytes(crs, { minX: 0, minY: 0, maxX: 100, maxY: 90 }, 40);
    const records: TinyCopc["records"] = [
      ["groma", 1, encodeRecord(record)],
      ["groma", 3, third],
    ];
    await expect(open({ records })).rejects.toThrow(
      expect.objectContaining({ code: "PLACE_DOMAIN", cause: expect.stringContaining("transformation") }),
    );
  });

  it("tells its name, count and box", async () => {
    const { cloud } = await open(withRecord);
    expect([cloud.name, cloud.pointCount, cloud.nodeCount]).toEqual(["tiny scan.copc.laz", 10, 1]);
    expect(cloud.boundingBox).toEqual({ min: [0, 0, 0], max: [100, 100, 50] });
  });

  it("goes by the octree's cube where the header's bounds are wrong from the start, and says so", async () => {
    const { cloud } = await open({
      bounds: [0, 0, 0, 0, 0, 0],
      page: [[1, 1, 1, 1, 0, 100, 10]],
      ...withRecord,
    });
    expect(cloud.boundingBox).toEqual({ min: [0, 0, 0], max: [100, 100, 100] });
    expect(cloud.warnings).toMatchObject([{ code: "BOUNDS_WRONG" }]);
    expect(cloud.bounds.radius).toBeGreaterThan(50);
  });

  it("goes by the cube as soon as a point lies outside of the declared bounds", async () => {
    const { cloud, executor } = await open({ ...twoNodes, ...withRecord, bounds: [0, 0, 0, 60, 60, 60] });
    executor.extent = Float64Array.of(0, 0, 0, 60.02, 60, 60);
    await cloud.loadNode("0-0-0-0");
    expect([cloud.warnings, cloud.boundingBox.max, cloud.bounds.radius < 60]).toEqual([
      [],
      [60, 60, 60],
      true,
    ]);
    const view: View = {
      ...{ position: [0, 0, 0], direction: [1, 0, 0], planes: [], height: 100, horizon: false },
      projection: { kind: "orthographic", extent: 1 },
    };
    const spheres = () =>
      cloud.stream
        .update({}, view, { maximumScreenSpaceError: 1e-3, pointBudget: 1e6 })
        .nodes.map(({ bounds }) => bounds?.radius ?? 0);
    const before = spheres();
    executor.extent = Float64Array.of(50, 0, 50, 100, 50, 100);
    await cloud.loadNode("1-1-0-1");
    await cloud.loadNode("1-1-0-1");
    expect(cloud.warnings).toMatchObject([{ code: "BOUNDS_WRONG" }]);
    expect(cloud.boundingBox.max).toEqual([100, 100, 100]);
    expect(cloud.attributes.find(({ name }) => name === "elevation")?.range).toEqual([0, 100]);
    const after = spheres();
    expect(after).toHaveLength(2);
    for (const [index, radius] of after.entries()) expect(radius).toBeGreaterThan(1.2 * before[index]);
  });

  it("has a sphere around all corners of its box", async () => {
    const { cloud } = await open({}, { crs: UTM, vertical: "ellipsoidal" });
    const exact = exactTransform(crs);
    const parts = new Float64Array(6);
    for (const [x, y, z] of [
      [0, 0, 0],
      [100, 0, 50],
      [100, 100, 0],
      [50, 50, 50],
    ]) {
      exact(x, y, parts, 0);
      const [px, py, pz] = [0, 1, 2].map((axis) => parts[axis] + z * parts[axis + 3]);
      const { bounds } = cloud;
      expect(Math.hypot(px - bounds.x, py - bounds.y, pz - bounds.z)).toBeLessThanOrEqual(bounds.radius);
      expect(bounds.radius).toBeLessThan(80);
    }
    // Not exactly 1: the zone's scale at its western edge.
    expect(cloud.bounds.spacing).toBeCloseTo(1, 1);
  });

  it("hands the worker a node's cube in source coordinates", async () => {
    const { cloud, executor } = await open({ ...twoNodes, ...withRecord });
    await cloud.loadNode("1-1-0-1");
    expect(executor.jobs.at(-1)).toMatchObject({ pointCount: 4, cube: [50, 0, 50, 50] });
    expect(executor.jobs.at(-1)?.chunk.byteLength).toBe(100);
  });

  it("PLACE_DOMAIN where the coordinates are none of the coordinate system", async () => {
    await expect(open({}, { crs: "+proj=longlat +datum=WGS84" })).rejects.toThrow(
      expect.objectContaining({ code: "PLACE_DOMAIN" }),
    );
  });

  it("RECORD_* for a record that is damaged", async () => {
    const records: TinyCopc["records"] = [["groma", 1, new TextEncoder().encode('{"version":1}')]];
    await expect(open({ records })).rejects.toThrow(expect.objectContaining({ name: "RecordError" }));
  });

  it("FORMAT_HIERARCHY where no node has points", async () => {
    await expect(open({ ...withRecord, page: [[0, 0, 0, 0, 0, 0, 0]] })).rejects.toThrow(
      expect.objectContaining({ code: "FORMAT_HIERARCHY" }),
    );
  });

  it("reads no more points once it is destroyed, and says so", async () => {
    const { cloud } = await open(withRecord);
    const query = cloud.query();
    cloud.destroy();
    const closed = expect.objectContaining({
      name: "AbortError",
      message: expect.stringContaining("closed"),
    });
    await expect(cloud.readPoint("0-0-0-0", 0)).rejects.toThrow(closed);
    await expect(cloud.loadNode("0-0-0-0")).rejects.toThrow(closed);
    await expect(query.bracket()).rejects.toThrow(closed);
    await expect(cloud.query().batches().next()).rejects.toThrow(closed);
  });

  it("leaves an executor that it was given alive", async () => {
    const { cloud, executor } = await open(withRecord);
    cloud.destroy();
    expect(executor.specs).toEqual([]);
    await expect(executor.run({ pointCount: 1 } as NodeJob)).resolves.toMatchObject({ count: 1 });
  });
});

import {
  ecefToGeodetic,
  encodeRecord,
  exactTransform,
  type GeoreferenceRecord,
  resolveCrs,
} from "@groma/georef";
import { describe, expect, it, vi } from "vitest";
import type { View } from "../octree/index.js";
import { pageBytes, type TinyCopc, tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource, type ByteSource } from "../sources/index.js";
import { recordFields } from "../sources/las/record-fields.js";
import type {
  ChunkJob,
  DataSetSpec,
  NodeExecutor,
  NodeJob,
  NodeRecords,
  NodeVertices,
} from "../workers/index.js";
import { transformationBytes } from "../workers/transformation.fixture.js";
import type { PointCloudOptions } from "./cloud-options.js";
import { PointCloud } from "./point-cloud.js";

const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
const FEET = { name: "foot", kind: "linear", size: 0.3048 } as const;
const crs = resolveCrs({ file: "a", given: UTM, givenVertical: "ellipsoidal" });

const record: GeoreferenceRecord = {
  version: 1,
  crs: { ...crs, name: "recorded", verticalUnit: { ...FEET, declared: true } },
  engine: { name: "proj4js", version: "2.22.0" },
  accuracy: [
    { name: "quantisation", metres: 0.005 },
    { name: "fit", metres: 0.001 },
  ],
};

/** Keeps jobs instead of doing them. */
class Recorder implements NodeExecutor {
  readonly specs: DataSetSpec[] = [];
  readonly jobs: NodeJob[] = [];
  readonly pending = 0;
  readonly asked: ChunkJob[] = [];
  rgbBits: 8 | 16 = 16;
  extent = Float64Array.of(0, 0, 0, 100, 100, 50);

  addDataSet(spec: DataSetSpec): number {
    return this.specs.push(spec);
  }

  removeDataSet(): void {
    this.specs.length = 0;
  }

  async run(job: NodeJob): Promise<NodeVertices> {
    this.jobs.push(job);
    const ranges = new Map([["intensity", [3, 700] as const]]);
    const { rgbBits } = this;
    const seen = job.appearance ?? { rgbBits, rgbBitsKnown: false, ranges };
    const { extent } = this;
    const columns = new Map([["rgb", { constant: [1, 2, 3, 255] }]]) as unknown as NodeVertices["columns"];
    return {
      count: job.pointCount,
      buffer: new ArrayBuffer(0),
      bytes: 0,
      seen,
      extent,
      columns,
      rgbBits,
    } as NodeVertices;
  }

  /** Records whose x is their number, drawn last first. */
  async records(job: ChunkJob): Promise<NodeRecords> {
    this.asked.push(job);
    const count = job.pointCount;
    const bytes = new Uint8Array(36 * count);
    const view = new DataView(bytes.buffer);
    const xyz = new Int32Array(3 * count);
    for (let record = 0; record < count; record++) {
      xyz[3 * record] = record;
      view.setUint16(36 * record + 12, 7 * record, true);
      view.setFloat64(36 * record + 22, 1e9 / 3 + record, true);
      view.setUint16(36 * record + 32, 65535, true);
    }
    const order = Uint16Array.from({ length: count }, (_, drawn) => count - 1 - drawn);
    const attributes = recordFields(7, []).map((field) => ({ ...field, bytes, stride: 36 }));
    return { count, xyz, attributes, order };
  }

  destroy(): void {}
}

async function open(file: TinyCopc = {}, options: PointCloudOptions = {}) {
  const executor = new Recorder();
  const source = new BlobSource(
    new Blob([tinyCopc(file).slice()]),
    "https://a.org/b%20c/tiny%20scan.copc.laz?x=1#y",
  );
  const cloud = await PointCloud.fromUrl(source, { executor, ...options });
  return { cloud, executor };
}

const withRecord: TinyCopc = { records: [["groma", 1, encodeRecord(record)]] };
const twoNodes: TinyCopc = {
  page: [
    [0, 0, 0, 0, 0, 100, 6],
    [1, 1, 0, 1, 0, 100, 4],
  ],
};

/** A root and two nodes behind further pages, each with one below it. */
function pagedFile(): Uint8Array {
  const make = (end: number) =>
    tinyCopc({
      page: [
        [0, 0, 0, 0, 0, 100, 4],
        [1, 1, 0, 1, end, 64, -1],
        [1, 0, 0, 0, end + 64, 64, -1],
      ],
    });
  const { length } = make(1);
  const head = make(length);
  const chunk = new DataView(head.buffer).getUint32(96, true);
  const pages = pageBytes([
    [1, 1, 0, 1, chunk, 100, 2],
    [2, 2, 0, 2, chunk, 100, 1],
    [1, 0, 0, 0, chunk, 100, 2],
    [2, 0, 0, 0, chunk, 100, 1],
  ]);
  const file = new Uint8Array(length + pages.length);
  file.set(head);
  file.set(pages, length);
  return file;
}

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

  it("judges colours and intensities by the node nearest the root, once for all", async () => {
    const { cloud, executor } = await open({ ...twoNodes, ...withRecord });
    executor.rgbBits = 8;
    await cloud.loadNode("1-1-0-1");
    executor.rgbBits = 16;
    await cloud.loadNode("0-0-0-0");
    expect(executor.jobs.map(({ node, appearance }) => [node, appearance?.rgbBits])).toEqual([
      ["0-0-0-0", undefined],
      ["1-1-0-1", 8],
      ["0-0-0-0", 8],
    ]);
    expect(cloud.attributes.find(({ name }) => name === "intensity")?.range).toEqual([3, 700]);
  });

  it("judges colours again with each node: one that needs 16 bits changes those that are here and to come", async () => {
    const { cloud, executor } = await open({ ...twoNodes, ...withRecord });
    executor.rgbBits = 8;
    const view: View = {
      ...{ position: [0, 0, 0], direction: [1, 0, 0], planes: [], height: 100, horizon: false },
      projection: { kind: "orthographic", extent: 1 },
    };
    const [root] = cloud.stream.update({}, view, { maximumScreenSpaceError: 100, pointBudget: 6 }).nodes;
    await vi.waitFor(() => expect(root.state).toBe("ready"));
    const early = cloud.stream.vertices(root)!;
    expect(early.columns.get("rgb")?.constant).toEqual([1, 2, 3, 255]);
    executor.rgbBits = 16;
    const needing = await cloud.loadNode("1-1-0-1");
    expect(cloud.stream.vertices(root)).toBe(early);
    expect(early.columns.get("rgb")).toMatchObject({ constant: [0, 0, 0, 255], bound: 1 });
    expect(needing.columns.get("rgb")?.constant).toEqual([1, 2, 3, 255]);
    await cloud.loadNode("0-0-0-0");
    expect(executor.jobs.map(({ appearance }) => appearance?.rgbBits)).toEqual([undefined, 8, 16]);
    executor.rgbBits = 8;
    const late = await cloud.loadNode("1-1-0-1");
    expect(late.columns.get("rgb")?.constant).toEqual([0, 0, 0, 255]);
  });

  it("lists its attributes: heights by the header, the others by the statistics where there are any", async () => {
    const statistics = {
      ...{ version: 1, points: 10, rgbBits: 16, classes: {}, returns: {} },
      attributes: [
        { name: "intensity", min: 5, max: 90, mean: 40 },
        { name: "gpsTime", min: 1e8, max: 2e8, mean: 1.5e8 },
      ],
    };
    const content = new TextEncoder().encode(JSON.stringify(statistics));
    const records: TinyCopc["records"] = [...(withRecord.records ?? []), ["groma", 2, content]];
    const { cloud, executor } = await open({ ...twoNodes, records });
    const byName = new Map(cloud.attributes.map((info) => [info.name, info]));
    expect([...byName.keys()]).toEqual([
      ...["rgb", "elevation", "ellipsoidalHeight", "intensity", "returnNumber", "numberOfReturns", "flags"],
      ...["classification", "userData", "scanAngle", "pointSourceId", "gpsTime"],
    ]);
    expect(byName.get("rgb")).toMatchObject({ kind: "color", components: 4, range: undefined });
    expect(byName.get("elevation")).toMatchObject({ kind: "scalar", unit: "foot", range: [0, 50] });
    const [lowest = Number.NaN, highest] = byName.get("ellipsoidalHeight")?.range ?? [];
    expect([lowest + 1, highest]).toEqual([expect.closeTo(1, 6), expect.closeTo(50 * 0.3048, 6)]);
    expect(byName.get("intensity")?.range).toEqual([5, 90]);
    expect(byName.get("classification")).toMatchObject({ kind: "class", range: undefined });
    expect(byName.get("flags")?.kind).toBe("flags");
    expect(cloud.attributes).toBe(cloud.attributes);
    await cloud.loadNode("1-1-0-1");
    expect(executor.jobs.map(({ node, appearance }) => [node, appearance?.ranges.get("gpsTime")])).toEqual([
      ["1-1-0-1", [1e8, 2e8]],
    ]);
  });

  it("DECODE_TOO_LARGE for a node that would unpack to gigabytes, before its chunk is read", async () => {
    const reads: number[] = [];
    const bytes = tinyCopc({ ...withRecord, points: 2 ** 24, recordLength: 36 });
    const chunkAt = new DataView(bytes.buffer).getUint32(96, true);
    const source: ByteSource = {
      ...{ name: "bomb.copc.laz", size: bytes.length },
      read: async (begin, end) => {
        reads.push(begin);
        return bytes.slice(begin, end);
      },
    };
    const executor = new Recorder();
    const cloud = await PointCloud.fromUrl(source, { executor });
    const tooLarge = expect.objectContaining({ code: "DECODE_TOO_LARGE", file: "bomb.copc.laz" });
    await expect(cloud.loadNode("0-0-0-0")).rejects.toThrow(tooLarge);
    await expect(cloud.readPoint("0-0-0-0", 0)).rejects.toThrow(tooLarge);
    expect([reads.includes(chunkAt), executor.jobs, executor.asked]).toEqual([false, [], []]);
  });

  it("finds the statistics of attributes whose names objects inherit, and of no others", async () => {
    const named = (name: string) => {
      const descriptor = new Uint8Array(192);
      descriptor[2] = 1;
      descriptor.set(new TextEncoder().encode(name), 4);
      return descriptor;
    };
    const statistics = {
      ...{ version: 1, points: 10, rgbBits: 16, classes: {}, returns: {} },
      attributes: [{ name: "__proto__", min: 5, max: 90, mean: 40 }],
    };
    const records: TinyCopc["records"] = [
      ...(withRecord.records ?? []),
      ["groma", 2, new TextEncoder().encode(JSON.stringify(statistics))],
      ["LASF_Spec", 4, Uint8Array.from([...named("__proto__"), ...named("constructor")])],
    ];
    const { cloud } = await open({ recordLength: 38, records });
    expect(cloud.attributes.slice(-2).map(({ name, range }) => [name, range])).toEqual([
      ["__proto__", [5, 90]],
      ["constructor", undefined],
    ]);
  });

  it("reads single points again, exactly as they are recorded", async () => {
    const { cloud, executor } = await open({ ...twoNodes, ...withRecord });
    const drawn = await cloud.readPoint("1-1-0-1", 0);
    expect(drawn).toMatchObject({ node: "1-1-0-1", index: 3, integers: [3, 0, 0] });
    expect(drawn.source[0]).toBeCloseTo(0.03, 12);
    expect(drawn.attributes).toMatchObject({ intensity: 21, gpsTime: 1e9 / 3 + 3, green: 65535 });
    const [recorded, other] = await Promise.all([
      cloud.readPoint("1-1-0-1", { record: 0 }),
      cloud.readPoint({ depth: 0, x: 0, y: 0, z: 0 }, { record: 5 }),
    ]);
    expect([recorded.index, other.node, other.index]).toEqual([0, "0-0-0-0", 5]);
    // The chunk was decoded once for the two points of its node.
    expect(executor.asked.map(({ node }) => node)).toEqual(["1-1-0-1", "0-0-0-0"]);
  });

  it("FORMAT_NODE for points that a node does not have, and the signal's reason once aborted", async () => {
    const { cloud } = await open({ ...twoNodes, ...withRecord });
    const missing = expect.objectContaining({ code: "FORMAT_NODE" });
    for (const point of [4, -1, 0.5, { record: 4 }, { record: -1 }]) {
      await expect(cloud.readPoint("1-1-0-1", point)).rejects.toThrow(missing);
    }
    await expect(cloud.readPoint("1-0-0-0", 0)).rejects.toThrow(missing);
    const signal = AbortSignal.abort(new Error("no longer"));
    await expect(cloud.readPoint("1-1-0-1", 0, { signal })).rejects.toThrow("no longer");
  });

  it("reads points of nodes whose pages were given up, by reading that page again and no other", async () => {
    const reads: number[] = [];
    const bytes = pagedFile();
    const source: ByteSource = {
      ...{ name: "a.copc.laz", size: bytes.length },
      read: async (begin, end) => {
        reads.push(begin);
        return bytes.slice(begin, end);
      },
    };
    const executor = new Recorder();
    const cloud = await PointCloud.fromUrl(source, {
      ...{ crs: UTM, executor, limits: { knownNodes: 1 } },
    });
    const pages = () => reads.splice(0).filter((begin) => begin >= bytes.length - 4 * 32);
    pages();
    const first = [await cloud.readPoint("1-1-0-1", 0), await cloud.readPoint("2-2-0-2", 0)];
    expect(cloud.nodeCount).toBe(3);
    expect(pages()).toEqual([bytes.length - 128, bytes.length - 128]);
    const other = await cloud.readPoint("1-0-0-0", 0);
    expect([cloud.nodeCount, other.node, pages()]).toEqual([3, "1-0-0-0", [bytes.length - 64]]);
    const again = [await cloud.readPoint("1-1-0-1", 0), await cloud.readPoint("2-2-0-2", 0)];
    expect(again).toEqual(first);
    // The records themselves were kept.
    expect(executor.asked.map(({ node }) => node)).toEqual(["1-1-0-1", "2-2-0-2", "1-0-0-0"]);
  });

  it("keeps a node in the octree while it is being loaded, and lets it go then", async () => {
    const executor = new Recorder();
    const source = new BlobSource(new Blob([pagedFile().slice()]), "a.copc.laz");
    const options = { crs: UTM, executor, limits: { knownNodes: 1 } };
    const cloud = await PointCloud.fromUrl(source, options);
    const names = ["1-1-0-1", "2-2-0-2", "1-0-0-0", "2-0-0-0", "1-1-0-1"];
    const loaded = await Promise.all(names.map((name) => cloud.loadNode(name)));
    expect(loaded.map(({ count }) => count)).toEqual([2, 1, 2, 1, 2]);
    expect(cloud.nodeCount).toBe(3);
  });

  it("stops taking in a page that is no longer wanted, and can read it later", async () => {
    const executor = new Recorder();
    const source = new BlobSource(new Blob([pagedFile().slice()]), "a.copc.laz");
    const cloud = await PointCloud.fromUrl(source, { crs: UTM, executor });
    const controller = new AbortController();
    const loading = cloud.loadNode("1-1-0-1", { signal: controller.signal });
    controller.abort(new Error("no longer"));
    await expect(loading).rejects.toThrow("no longer");
    expect(cloud.nodeCount).toBe(3);
    await expect(cloud.loadNode("1-1-0-1")).resolves.toMatchObject({ count: 2 });
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

  it("leaves an executor that it was given alive", async () => {
    const { cloud, executor } = await open(withRecord);
    cloud.destroy();
    expect(executor.specs).toEqual([]);
    await expect(executor.run({ pointCount: 1 } as NodeJob)).resolves.toMatchObject({ count: 1 });
  });
});

import { describe, expect, it, vi } from "vitest";
import type { View } from "../octree/index.js";
import { NodeAccess } from "../query/index.js";
import { type TinyCopc, tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource, type ByteSource } from "../sources/index.js";
import type { NodeJob } from "../workers/index.js";
import { open, pagedFile, Recorder, twoNodes, UTM, withRecord } from "./opened-cloud.fixture.js";
import { PointCloud } from "./point-cloud.js";

describe("nodes and points of a PointCloud", () => {
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

  it.each([
    ["before the octree is opened, where it is here", 0, ["0-0-0-0", "opened"]],
    ["for whoever asks before it is here", 20, ["opened", "0-0-0-0"]],
  ])("has the root made once %s", async (_, delay, order) => {
    const statistics = { version: 1, points: 10, rgbBits: 16, classes: {}, returns: {}, attributes: [] };
    const content = new TextEncoder().encode(JSON.stringify(statistics));
    const bytes = tinyCopc({ records: [...(withRecord.records ?? []), ["groma", 2, content]] });
    const chunkAt = new DataView(bytes.buffer).getUint32(96, true);
    const source: ByteSource = {
      ...{ name: "a.copc.laz", size: bytes.length },
      read: async (begin, end) => {
        if (begin === chunkAt && delay > 0) await new Promise((resume) => setTimeout(resume, delay));
        return bytes.slice(begin, end);
      },
    };
    const seen: string[] = [];
    class Noting extends Recorder {
      override run(job: NodeJob) {
        seen.push(job.node);
        return super.run(job);
      }
    }
    const openRoot = vi.spyOn(NodeAccess.prototype, "openRoot");
    openRoot.mockImplementationOnce(function (this: NodeAccess, signal) {
      seen.push("opened");
      return this.openRoot(signal);
    });
    const cloud = await PointCloud.open(source, { executor: new Noting() }, true);
    cloud.stream.loadRoot();
    await vi.waitFor(() => expect(cloud.globe.store.root.state).toBe("ready"));
    expect(seen).toEqual(order);
    openRoot.mockRestore();
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
});

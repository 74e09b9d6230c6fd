import { exactTransform, pointTransform, resolveCrs, WEB_MERCATOR_PLANE } from "@groma/georef";
import proj4 from "proj4";
import { describe, expect, it } from "vitest";
import type { View } from "../octree/index.js";
import { tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource, type ByteSource } from "../sources/index.js";
import type { DataSetSpec, NodeExecutor, NodeJob, NodeVertices } from "../workers/index.js";
import type * as mapOctrees from "./map-octrees.js";
import type { MapProjection } from "./map-octrees.js";
import { PointCloud } from "./point-cloud.js";

const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
const MERCATOR: MapProjection = {
  ...{
    code: "EPSG:3857",
    definition: proj4.defs("EPSG:3857"),
    metresPerUnit: 1,
    wraps: true,
    tolerance: 0.01,
  },
};
const OWN: MapProjection = { ...MERCATOR, code: "EPSG:32632", definition: `${UTM} +no_defs`, wraps: false };
const POLE = { ...MERCATOR, code: "pole", definition: "+proj=nowhere" };

/** Sees all of a data set, so near that its first node is wanted. */
const EVERYTHING: View = {
  ...{ position: [0, 0, 1e9], direction: [0, 0, -1], planes: [], height: 1e6, horizon: false },
  projection: { kind: "orthographic", extent: 100 },
};

async function open() {
  const specs: DataSetSpec[] = [];
  const jobs: NodeJob[] = [];
  const removed: number[] = [];
  const executor = {
    ...{ pending: 0, removeDataSet: (dataSet: number) => removed.push(dataSet), destroy: () => undefined },
    addDataSet: (spec: DataSetSpec) => specs.push(spec),
    run: async (job: NodeJob) => {
      jobs.push(job);
      const extent = Float64Array.of(0, 0, 0, 1, 1, 1);
      return { count: job.pointCount, bytes: 1, extent, columns: new Map() } as unknown as NodeVertices;
    },
  } as unknown as NodeExecutor;
  const blob = new BlobSource(new Blob([tinyCopc({ points: 10 }).slice()]), "tiny.copc.laz");
  const reads: string[] = [];
  const source: ByteSource = {
    name: blob.name,
    size: blob.size,
    read(begin, end, options) {
      reads.push(`${begin}-${end}`);
      return blob.read(begin, end, options);
    },
  } as ByteSource;
  const cloud = await PointCloud.fromUrl(source, { executor, crs: UTM, vertical: "ellipsoidal" });
  return { cloud, specs, jobs, reads, removed };
}

const settled = async (cloud: PointCloud, view: object, octree = cloud.globe) => {
  octree.stream.update(view, EVERYTHING, { maximumScreenSpaceError: 1, pointBudget: 1e6 });
  while (octree.stream.active > 0) await new Promise((resolve) => setTimeout(resolve));
};

describe("a data set on maps", () => {
  it("is read once for the globe and for maps, and decoded for each", async () => {
    const { cloud, jobs, reads } = await open();
    const [globe, map] = [{}, {}];
    await settled(cloud, globe);
    const before = [...reads];
    expect(jobs.map(({ dataSet }) => dataSet)).toEqual([1]);
    const octree = await cloud.maps.acquire(MERCATOR);
    await settled(cloud, map, octree);
    expect(jobs.map(({ dataSet }) => dataSet)).toEqual([1, 2]);
    expect(reads).toEqual(before);
    cloud.destroy();
  });

  it("has one octree for each projection, as long as a view uses it", async () => {
    const { cloud, specs } = await open();
    const [first, second] = await Promise.all([cloud.maps.acquire(MERCATOR), cloud.maps.acquire(MERCATOR)]);
    expect(second).toBe(first);
    expect(await cloud.maps.acquire(OWN)).not.toBe(first);
    cloud.maps.release(first);
    expect(await cloud.maps.acquire(MERCATOR)).toBe(first);
    cloud.maps.release(first);
    cloud.maps.release(first);
    expect(await cloud.maps.acquire(MERCATOR)).not.toBe(first);
    expect(specs.map(({ plane }) => plane?.own)).toEqual([undefined, false, true, false]);
    cloud.destroy();
  });

  it("is placed to the tolerance of the map where that is less than its own", async () => {
    const { cloud, specs } = await open();
    await cloud.maps.acquire(MERCATOR);
    await cloud.maps.acquire({ ...MERCATOR, tolerance: 2e-4 });
    expect(specs.map(({ tolerance }) => tolerance)).toEqual([0.001, 0.001, 2e-4]);
  });

  it("has one octree for all maps that ask for no more than its own tolerance, and finer ones for others", async () => {
    const { cloud } = await open();
    const coarse = await cloud.maps.acquire(MERCATOR);
    expect(await cloud.maps.acquire({ ...MERCATOR, tolerance: 0.03 })).toBe(coarse);
    const fine = await cloud.maps.acquire({ ...MERCATOR, tolerance: 2e-4 });
    expect(fine).not.toBe(coarse);
    cloud.maps.release(coarse);
    cloud.maps.release(coarse);
    expect(await cloud.maps.acquire({ ...MERCATOR, tolerance: 2e-4 })).toBe(fine);
    expect(await cloud.maps.acquire(MERCATOR)).not.toBe(coarse);
    cloud.destroy();
  });

  it("refuses a projection that is none, and goes on with others", async () => {
    const { cloud } = await open();
    await expect(cloud.maps.acquire(POLE)).rejects.toThrow(/CRS_UNSUPPORTED: pole/);
    await expect(cloud.maps.acquire(POLE)).rejects.toThrow(/CRS_UNSUPPORTED: pole/);
    expect((await cloud.maps.acquire(MERCATOR)).plane?.code).toBe("EPSG:3857");
  });

  it("says so where it has no place in the projection", async () => {
    const { cloud } = await open();
    const far = { ...MERCATOR, code: "far", definition: "+proj=gnom +lat_0=-90 +lon_0=0 +ellps=WGS84" };
    await expect(cloud.maps.acquire(far)).rejects.toThrow(/PLACE_MAP/);
  });

  it("leaves nothing in an executor of others, where it goes while one is opened", async () => {
    const { cloud, specs, removed } = await open();
    const opening = cloud.maps.acquire(OWN);
    cloud.destroy();
    await opening.catch(() => undefined);
    expect(specs).toHaveLength(2);
    await expect.poll(() => removed).toEqual([1, 2]);
  });

  it("CRS_NOT_LOADED where a projection is asked for at once, before any but Web Mercator is loaded", async () => {
    // A module of its own: for others of this run the projections may have come already.
    const fresh = "./map-octrees.js?fresh";
    const { MapOctrees, loadProjections }: typeof mapOctrees = await import(fresh);
    const crs = resolveCrs({ file: "a", given: UTM });
    const boundingBox = { min: [500_000, 5_000_000, 0], max: [500_100, 5_000_100, 9] };
    const data = { crs, truth: exactTransform(crs), spec: { heights: [0, 9] }, now: () => ({ boundingBox }) };
    const maps = new MapOctrees({ source: { name: "a" } } as never, data as never);
    const there = new Float64Array(3);
    pointTransform(maps.truthIn(WEB_MERCATOR_PLANE))(500_000, 5_000_000, 0, there, 0);
    const [, y] = proj4(UTM, "EPSG:3857").forward([500_000, 5_000_000]);
    expect(there[1]).toBeCloseTo(y, 6);
    expect(() => maps.truthIn(OWN)).toThrow(expect.objectContaining({ code: "CRS_NOT_LOADED" }));
    await loadProjections();
    expect(maps.truthIn(OWN)).toBeTypeOf("function");
  });
});

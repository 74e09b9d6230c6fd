import { describe, expect, it } from "vitest";
import { PointCloud } from "../cloud/index.js";
import { tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource } from "../sources/index.js";
import type { NodeExecutor } from "../workers/index.js";
import { PointCloudLayer } from "./point-cloud-layer.js";

const executor = { addDataSet: () => 1, removeDataSet: () => undefined } as unknown as NodeExecutor;

async function open(): Promise<PointCloud> {
  const source = new BlobSource(new Blob([tinyCopc().slice()]), "tiny.copc.laz");
  const crs = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
  return PointCloud.fromUrl(source, { executor, crs, vertical: "ellipsoidal" });
}

describe("PointCloudLayer.heightOffset", () => {
  it("moves what is flown to, and nothing that is told of the points", async () => {
    const cloud = await open();
    const before = { place: cloud.place(20, 30, 40), accuracy: cloud.accuracy, bounds: { ...cloud.bounds } };
    const layer = PointCloudLayer.fromCloud(cloud, { heightOffset: 5 });
    const { center } = layer.boundingSphere;
    const at = [center.x, center.y, center.z];
    layer.heightOffset = 105;
    expect(Math.hypot(center.x - at[0], center.y - at[1], center.z - at[2])).toBeCloseTo(100, 6);
    expect({ place: cloud.place(20, 30, 40), accuracy: cloud.accuracy, bounds: cloud.bounds }).toEqual(
      before,
    );
    layer.heightOffset = 0;
    const { x, y, z } = cloud.bounds;
    expect([center.x, center.y, center.z]).toEqual([x, y, z]);
  });

  it("goes up", async () => {
    const cloud = await open();
    const layer = PointCloudLayer.fromCloud(cloud, { heightOffset: 1000 });
    const { center } = layer.boundingSphere;
    const { x, y, z } = cloud.bounds;
    expect(Math.hypot(center.x, center.y, center.z)).toBeGreaterThan(Math.hypot(x, y, z) + 990);
  });

  it("STYLE_HEIGHT_OFFSET for what is no length, and stays as it was", async () => {
    const layer = PointCloudLayer.fromCloud(await open(), { heightOffset: 3 });
    expect(() => {
      layer.heightOffset = Number.NaN;
    }).toThrow(expect.objectContaining({ code: "STYLE_HEIGHT_OFFSET" }));
    expect(layer.heightOffset).toBe(3);
  });
});

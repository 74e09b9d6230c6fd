import { openAsBlob } from "node:fs";
import { PointCloud } from "@groma/layer";
import { measureVolume, sourceVertex } from "@groma/layer/tools";
import { describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { localExecutor } from "../faults/local-executor.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";

const scan = data("vol_total.laz");
const missing = scan.missing ?? coreMissing ?? pythonMissing;

describe.skipIf(missing)(`the volume over a ring of a real scan${missing ? ` (${missing})` : ""}`, () => {
  it("is that of scipy's triangles of laspy's points", { timeout: 280_000 }, async () => {
    const cloud = await PointCloud.fromUrl(await openAsBlob(converted(scan.path)), {
      executor: localExecutor(),
    });
    try {
      const { min, max } = cloud.boundingBox;
      const [x, y, z] = [0, 1, 2].map((axis) => (min[axis]! + max[axis]!) / 2) as [number, number, number];
      const corners = [0, 1, 2, 3, 4].map((i): [number, number] => {
        const angle = (2 * Math.PI * i) / 5;
        return [x + 8 * Math.cos(angle), y + 6 * Math.sin(angle)];
      });
      const heights: number[] = [];
      for await (const { records, inside } of cloud.query().batches()) {
        for (const point of inside) {
          const [px, py] = [0, 1].map(
            (axis) => records.xyz[3 * point + axis]! * cloud.scale[axis]! + cloud.offset[axis]!,
          );
          if (Math.hypot(px! - x, py! - y) < 5)
            heights.push(records.xyz[3 * point + 2]! * cloud.scale[2] + cloud.offset[2]);
        }
      }
      heights.sort((a, b) => a - b);
      const height = heights[heights.length >> 1] ?? z;
      const ring = corners.map(([u, v]) => sourceVertex(cloud, [u, v, height]));
      const shares: number[] = [];
      const volume = await measureVolume(cloud, ring, {
        base: { kind: "height", height },
        precision: 0.02,
        onProgress: (share) => shares.push(share),
      });
      const referee = runPython<{ cut: number; fill: number; points: number }>(
        "interop/volume.py",
        [],
        JSON.stringify({ file: scan.path, ring: corners, margin: 0.05, height }),
      );
      // Lengths of the plan are those of the ground: LV03's scale there is within 1e-4 of 1, and heights are 450 m.
      for (const name of ["cut", "fill"] as const) {
        expect(referee[name]).toBeGreaterThan(1);
        expect(Math.abs(volume[name].value / referee[name] - 1)).toBeLessThan(1e-3);
        // A polygon whose vertices are no records: what its edges are worth nobody knows.
        expect(volume[name].uncertainty).toBeNull();
        expect(volume[name].atLeast).toBeGreaterThan(0);
      }
      expect(Math.abs(volume.points - referee.points)).toBeLessThan(0.01 * referee.points);
      expect(volume.covered).toBeCloseTo(volume.area, 6);
      expect(shares.at(-1)).toBe(1);
      const signal = AbortSignal.abort(new Error("enough"));
      await expect(measureVolume(cloud, ring, { signal })).rejects.toThrow("enough");
      const foreign = ring.map(({ ecef, longitude, latitude, height: h }) => ({
        ecef,
        longitude,
        latitude,
        height: h,
      }));
      await expect(measureVolume(cloud, foreign)).rejects.toMatchObject({ code: "MEASURE_DATASET" });
    } finally {
      cloud.destroy();
    }
  });
});

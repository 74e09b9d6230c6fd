import { createHash } from "node:crypto";
import { openAsBlob } from "node:fs";
import { PointCloud, type QueryVolume } from "@groma/layer";
import { describe, expect, it } from "vitest";
import { converted } from "../converted.js";
import { localExecutor } from "../faults/local-executor.js";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { coreMissing } from "./core.js";

const scan = data("vol_total.laz");

/** A disc over the plane, by the same sum of squares as the referee's. */
function disc(centreX: number, centreY: number, radius: number): QueryVolume {
  return {
    toBox(box) {
      const reach = (axis: number, centre: number) =>
        Math.max(Math.abs(box[axis] - centre), Math.abs(box[axis + 3] - centre));
      if (Math.hypot(reach(0, centreX), reach(1, centreY)) < radius) return "in";
      const gap = (axis: number, centre: number) => Math.max(0, box[axis] - centre, centre - box[axis + 3]);
      return Math.hypot(gap(0, centreX), gap(1, centreY)) > radius ? "out" : "crossing";
    },
    contains: (x, y) => (x - centreX) ** 2 + (y - centreY) ** 2 <= radius ** 2,
  };
}

describe.skipIf(scan.missing ?? coreMissing ?? pythonMissing)("a query of a real scan", () => {
  it.each([5, 20, 60, 1e6])("finds just the records that laspy finds within %d m", async (radius) => {
    const cloud = await PointCloud.fromUrl(await openAsBlob(converted(scan.path)), {
      executor: localExecutor(),
    });
    try {
      const { min, max } = cloud.boundingBox;
      const [x, y] = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2];
      const referee = runPython<{ count: number; digest: string }>("interop/inside.py", [
        scan.path,
        ...[x, y, radius].map(String),
      ]);
      const query = cloud.query({ volume: disc(x, y, radius) });
      const { least, most } = await query.bracket();
      const rows: Int32Array[] = [];
      for await (const { records, inside } of query.batches()) {
        for (const point of inside) rows.push(records.xyz.subarray(3 * point, 3 * point + 3));
      }
      rows.sort((a, b) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2]);
      const hash = createHash("sha256");
      for (const row of rows) hash.update(row);
      expect(rows.length).toBe(referee.count);
      expect(hash.digest("hex")).toBe(referee.digest);
      expect(rows.length).toBeGreaterThan(0);
      expect(least).toBeLessThanOrEqual(rows.length);
      expect(most).toBeGreaterThanOrEqual(rows.length);
      if (radius === 1e6) expect([least, most]).toEqual([cloud.pointCount, cloud.pointCount]);
    } finally {
      cloud.destroy();
    }
  });
});

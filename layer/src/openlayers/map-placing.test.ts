import { get } from "ol/proj.js";
import { expect, it, vi } from "vitest";
import type { PointCloud } from "../cloud/index.js";
import { MapPlacing } from "./map-placing.js";

it("has points that could not be placed placed anew when asked to, and not before", async () => {
  const acquire = vi.fn().mockRejectedValue(new Error("out of reach"));
  const cloud = { name: "a.copc.laz", maps: { acquire } } as unknown as PointCloud;
  const failed = vi.fn();
  const placing = new MapPlacing({}, { changed: () => undefined, failed });
  const want = () => {
    placing.want({ cloud, projection: get("EPSG:3857")!, finest: 0.1 }, {} as WebGL2RenderingContext);
    return placing.pending;
  };
  expect(want()).toBe(true);
  await vi.waitFor(() => expect(failed).toHaveBeenCalledTimes(1));
  expect(want()).toBe(false);
  placing.retryFailed();
  expect(want()).toBe(true);
  placing.retryFailed();
  expect(want()).toBe(true);
  await vi.waitFor(() => expect(failed).toHaveBeenCalledTimes(2));
  expect(acquire).toHaveBeenCalledTimes(2);
});

import {
  EllipsoidTerrainProvider,
  GeographicTilingScheme,
  HeightmapTerrainData,
  type TerrainProvider,
} from "cesium";
import { describe, expect, it } from "vitest";
import { terrainOf } from "./terrain.js";

/** A provider whose tiles of the finest level, 9, are as high as their level. */
function provider(asked: number[] = []): TerrainProvider {
  const tilingScheme = new GeographicTilingScheme();
  return {
    tilingScheme,
    availability: { computeMaximumLevelAtPosition: () => 9 },
    requestTileGeometry: async (_x: number, _y: number, level: number) => {
      asked.push(level);
      return new HeightmapTerrainData({ buffer: new Float32Array(4).fill(level), width: 2, height: 2 });
    },
  } as unknown as TerrainProvider;
}

describe("a terrain of Cesium", () => {
  it("has the heights of its finest tiles, metres above the ellipsoid", async () => {
    const asked: number[] = [];
    const terrain = terrainOf(() => provider(asked), { precision: 3 });
    expect(await terrain.heightAt(0.12, 0.8)).toBeCloseTo(9, 6);
    expect(asked).toEqual([9]);
    expect(terrain.precision).toBe(3);
  });

  it("has none where it is the bare ellipsoid, and stops with the signal", async () => {
    expect(await terrainOf(() => new EllipsoidTerrainProvider()).heightAt(0, 0)).toBeUndefined();
    const stopped = AbortSignal.abort(new Error("enough"));
    await expect(terrainOf(() => provider()).heightAt(0, 0, stopped)).rejects.toThrow("enough");
  });
});

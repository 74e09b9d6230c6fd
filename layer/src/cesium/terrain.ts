import { Cartographic, sampleTerrainMostDetailed, type TerrainProvider } from "cesium";
import type { Terrain } from "../tools/index.js";

/** What is known of a terrain. */
export interface TerrainOfOptions {
  /** One standard deviation of its heights, metres. Default: unknown. */
  readonly precision?: number | undefined;
}

/**
 * A terrain of Cesium as heights for a `MeasureTool` or `measureHeightAboveTerrain`: those of its finest tiles at a place,
 * not of the tiles that happen to be drawn. The bare ellipsoid, which is no terrain, has none, nor have providers that do
 * not tell which tiles there are.
 * @param provider asked for anew each time: `() => viewer.terrainProvider`
 */
export function terrainOf(provider: () => TerrainProvider, { precision }: TerrainOfOptions = {}): Terrain {
  return {
    name: "terrain",
    precision,
    async heightAt(longitude, latitude, signal) {
      signal?.throwIfAborted();
      const terrain = provider();
      if (!terrain.availability) return undefined;
      const place = new Cartographic(longitude, latitude, Number.NaN);
      await sampleTerrainMostDetailed(terrain, [place], true);
      signal?.throwIfAborted();
      return Number.isFinite(place.height) ? place.height : undefined;
    },
  };
}

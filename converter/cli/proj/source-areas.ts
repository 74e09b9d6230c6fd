import type { AreaOfUse, Rectangle } from "@groma/georef";
import { runPipeline } from "./cct.js";
import type { Proj } from "./program/find.js";
import { type StepText, TO_RADIANS } from "./step-text.js";

/** Points along each edge of an area, as many as PROJ takes (`reproject_bbox`). */
const ALONG = 21;
/** In place of no end: finite, as the numbers of a record are. */
const FAR = 1e12;

/**
 * The rectangles of source coordinates in which PROJ takes a point for one of an area of use: around the edge of the area,
 * projected. Two where it goes across the antimeridian; one without end where it is the earth.
 *
 * @param projection from source coordinates to longitude and latitude in radians
 * @throws ProjError PROJ_FAILED when the projection has no way back, PROJ_OUTPUT
 */
export async function rectanglesOf(
  proj: Proj,
  projection: readonly StepText[],
  areas: readonly AreaOfUse[],
  signal?: AbortSignal,
): Promise<Rectangle[][]> {
  const halves = areas.map(([west, south, east, north]): AreaOfUse[] =>
    west <= east
      ? [[west, south, east, north]]
      : [
          [west, south, 180, north],
          [-180, south, east, north],
        ],
  );
  const edges = halves.flat().map((half) => (isEarth(half) ? [] : edgeOf(half)));
  const back = [...projection].reverse().map((step) => ({ ...step, inverse: !step.inverse }));
  const places = await runPipeline(proj, [TO_RADIANS, ...back], Float64Array.from(edges.flat(2)), signal);
  let at = 0;
  return halves.map((parts) =>
    parts.map((part) => {
      if (isEarth(part)) return { minX: -FAR, minY: -FAR, maxX: FAR, maxY: FAR };
      const end = at + 3 * 4 * ALONG;
      let [minX, minY, maxX, maxY] = [Infinity, Infinity, -Infinity, -Infinity];
      for (; at < end; at += 3) {
        if (!Number.isFinite(places[at]! + places[at + 1]!)) continue;
        minX = Math.min(minX, places[at]!);
        maxX = Math.max(maxX, places[at]!);
        minY = Math.min(minY, places[at + 1]!);
        maxY = Math.max(maxY, places[at + 1]!);
      }
      return { minX, minY, maxX, maxY };
    }),
  );
}

function isEarth([west, south, east, north]: AreaOfUse): boolean {
  return west === -180 && east === 180 && south === -90 && north === 90;
}

/** Longitude, latitude, 0 of points along the edge. */
function edgeOf([west, south, east, north]: AreaOfUse): number[][] {
  return Array.from({ length: ALONG }, (_, i) => {
    const share = i / (ALONG - 1);
    const [x, y] = [west + share * (east - west), south + share * (north - south)];
    return [
      [x, south, 0],
      [x, north, 0],
      [west, y, 0],
      [east, y, 0],
    ];
  }).flat();
}

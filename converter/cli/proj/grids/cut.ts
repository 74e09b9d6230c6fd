import { type Bounds, cutWindow, type Grid, type GridWindow } from "@groma/georef";
import { composite } from "./composite.js";
import { boundsOf, type GridImage, holds, touches } from "./grid-image.js";

/**
 * Cuts the window that the bounds need from the grid that PROJ would take there: the first of the outermost ones that
 * holds the place, and below it the innermost. Where finer grids cover the bounds only in part, the window is made
 * of all of them.
 *
 * @param roots outermost grids in the order in which PROJ looks at them
 * @returns nothing when no grid covers the bounds, not even in part
 */
export async function cutFrom(roots: readonly GridImage[], bounds: Bounds): Promise<GridWindow | undefined> {
  const root = roots.find((grid) => holds(grid, bounds)) ?? roots.find((grid) => touches(grid, bounds));
  if (!root) return undefined;
  return cutWindow(await gridFor(root, bounds), bounds);
}

async function gridFor(image: GridImage, bounds: Bounds): Promise<Grid> {
  const inner = image.children.filter((child) => touches(child, bounds));
  if (inner.length === 0) return image.load(bounds);
  if (inner.length === 1 && holds(inner[0], bounds)) return gridFor(inner[0], bounds);
  const parts = [];
  for (const child of inner) {
    const area = boundsOf(child);
    parts.push({ area, grid: await gridFor(child, bounds) });
  }
  return composite(await image.load(bounds), parts);
}

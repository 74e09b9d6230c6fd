import type { Page } from "playwright-core";

/** Vertices along a side of a tile. */
const SIDE = 17;
/** u, v and heights go from 0 to this over a tile. */
const STEPS = 32_767;
const HEADER = 88;
const RADIANS = Math.PI / 180;

/** Height above the ellipsoid, metres, at a longitude and latitude in radians. */
type HeightAt = (longitude: number, latitude: number) => number;

/** Serves a terrain to a page at `folder`: quantized-mesh-1.0, as the terrain servers of the field have it, all levels to 15. */
export async function serveTerrain(page: Page, folder: string, heightAt: HeightAt): Promise<void> {
  const levels = Array.from({ length: 16 }, (_, z) => [
    { startX: 0, startY: 0, endX: 2 ** (z + 1) - 1, endY: 2 ** z - 1 },
  ]);
  const layer = {
    ...{ tilejson: "2.1.0", format: "quantized-mesh-1.0", version: "1.0.0", scheme: "tms" },
    ...{ tiles: ["{z}/{x}/{y}.terrain"], projection: "EPSG:4326", bounds: [-180, -90, 180, 90] },
    available: levels,
  };
  await page.route(`**${folder}layer.json`, (route) => route.fulfill({ json: layer }));
  await page.route(`**${folder}*/*/*.terrain*`, (route) => {
    const [z, x, y] = /(\d+)\/(\d+)\/(\d+)\.terrain/.exec(route.request().url())!.slice(1).map(Number);
    const degrees = 180 / 2 ** z!;
    const [west, south] = [x! * degrees - 180, y! * degrees - 90];
    const tile = meshTile({ west, south, east: west + degrees, north: south + degrees }, heightAt);
    return route.fulfill({ body: tile, contentType: "application/vnd.quantized-mesh" });
  });
}

/**
 * A tile as https://github.com/CesiumGS/quantized-mesh has it.
 * @param edges degrees
 */
function meshTile(
  edges: { readonly west: number; readonly south: number; readonly east: number; readonly north: number },
  heightAt: HeightAt,
): Buffer {
  const [west, south, east, north] = [edges.west, edges.south, edges.east, edges.north].map(
    (at) => at * RADIANS,
  );
  const grid = Array.from({ length: SIDE * SIDE }, (_, at) => {
    const [i, j] = [at % SIDE, Math.floor(at / SIDE)].map((index) => index / (SIDE - 1));
    return { u: i!, v: j!, height: heightAt(west! + i! * (east! - west!), south! + j! * (north! - south!)) };
  });
  const heights = grid.map(({ height }) => height);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const middle = ecef((west! + east!) / 2, (south! + north!) / 2, (low + high) / 2);
  const corners = [west!, east!].flatMap((x) => [south!, north!].map((y) => ecef(x, y, high)));
  const radius = Math.max(
    ...corners.map((corner) => Math.hypot(...corner.map((at, axis) => at - middle[axis]!))),
  );
  const cells = Array.from({ length: SIDE - 1 }, (_, index) => index);
  const triangles = cells.flatMap((j) =>
    cells.flatMap((i) => {
      const at = j * SIDE + i;
      return [at, at + 1, at + SIDE, at + SIDE, at + 1, at + SIDE + 1];
    }),
  );
  const along = Array.from({ length: SIDE }, (_, index) => index);
  const sides = [
    along.map((j) => j * SIDE),
    along,
    along.map((j) => j * SIDE + SIDE - 1),
    along.map((i) => (SIDE - 1) * SIDE + i),
  ];
  const size = HEADER + 4 + 6 * grid.length + 4 + 2 * triangles.length + sides.length * (4 + 2 * SIDE);
  const tile = Buffer.alloc(size);
  let at = 0;
  const double = (value: number) => {
    at = tile.writeDoubleLE(value, at);
  };
  middle.forEach(double);
  at = tile.writeFloatLE(low, at);
  at = tile.writeFloatLE(high, at);
  for (const value of [...middle, radius]) double(value);
  // The point that is seen as soon as any of the tile is: from all above its half of the earth, so that nothing is left out.
  for (const [axis, value] of middle.entries()) double((1e9 * value) / [6378137, 6378137, 6356752.3][axis]!);
  at = tile.writeUInt32LE(grid.length, at);
  const scale = high > low ? 1 / (high - low) : 0;
  for (const of of [
    grid.map(({ u }) => u),
    grid.map(({ v }) => v),
    grid.map(({ height }) => (height - low) * scale),
  ]) {
    let before = 0;
    for (const value of of.map((share) => Math.round(share * STEPS))) {
      const step = value - before;
      at = tile.writeUInt16LE(step < 0 ? -2 * step - 1 : 2 * step, at);
      before = value;
    }
  }
  at = tile.writeUInt32LE(triangles.length / 3, at);
  let next = 0;
  for (const index of triangles) {
    at = tile.writeUInt16LE((next - index) & 0xffff, at);
    if (index === next) next++;
  }
  for (const side of sides) {
    at = tile.writeUInt32LE(side.length, at);
    for (const index of side) at = tile.writeUInt16LE(index, at);
  }
  return tile;
}

/** WGS 84 → EPSG:4978, metres. */
function ecef(longitude: number, latitude: number, height: number): number[] {
  const [a, e2] = [6378137, 0.00669437999014];
  const n = a / Math.sqrt(1 - e2 * Math.sin(latitude) ** 2);
  return [
    (n + height) * Math.cos(latitude) * Math.cos(longitude),
    (n + height) * Math.cos(latitude) * Math.sin(longitude),
    (n * (1 - e2) + height) * Math.sin(latitude),
  ];
}

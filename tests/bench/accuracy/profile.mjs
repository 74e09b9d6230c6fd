import { existsSync, statSync } from "node:fs";
import { join } from "node:path";
import { geodesicFrom } from "@groma/georef";
import { Corridor, TerrainLine } from "@groma/layer/tools";
import proj4 from "proj4";
import { converted } from "../converted.mjs";

const DEGREE = Math.PI / 180;

/** Scans, the line through each as shares of its bounds, width and station interval in its units. */
const SCANS = [
  { scan: "vol_total.laz", from: [0.1, 0.5], to: [0.9, 0.5], width: 2, interval: 1 },
  { scan: "autzen.laz", from: [0.1, 0.3], to: [0.9, 0.6], width: 10, interval: 5 },
];

/** Spacings that are asked for, in units of the scan, from coarse to every point. */
const SPACINGS = [64, 32, 16, 8, 4, 2, 1, 0.5, 0.25, 0];

/** How often every level is read, in turns: the least time of each counts, once everything is compiled. */
const ROUNDS = 5;

/**
 * The picture of a profile at each level: points read and shown, time of the processor, and how far its ground (median of each station) lies
 * from that of all points; stations without a point are counted apart.
 */
export async function measurePicture(root) {
  const { openPoints } = await import(join(root, "converter/dist/files/points.js"));
  const rows = [];
  for (const { scan, from, to, width, interval } of SCANS) {
    const file = join(root, "../shared/data", scan);
    if (!existsSync(file)) continue;
    const copc = converted(root, file);
    const { points: origin, close } = await openPoints(copc, new AbortController().signal);
    const { min, max } = origin.source.boundingBox;
    const at = ([x, y]) => [min[0] + x * (max[0] - min[0]), min[1] + y * (max[1] - min[1])];
    const strip = new Corridor([at(from), at(to)], width);
    const rounds = [];
    for (let round = 0; round < ROUNDS; round++) {
      const levels = [];
      for (const spacing of SPACINGS) levels.push(await level(origin, strip, interval, spacing));
      rounds.push(levels);
    }
    const least = (index) => Math.min(...rounds.map((one) => one[index].ms));
    const levels = rounds[0].map((one, index) => ({ ...one, ms: least(index) }));
    const whole = levels[levels.length - 1];
    const known = new Set();
    for (const one of levels) {
      if (known.has(one.read)) continue;
      known.add(one.read);
      const { rms, missing } = difference(one.stations, whole.stations);
      const { stations: _stations, ...rest } = one;
      rows.push({ scan, ...rest, rms, missing, share: one.shown / whole.shown, time: one.ms / whole.ms });
    }
    const { size } = statSync(copc);
    for (const row of rows.filter((one) => one.scan === scan))
      row.bytes = Math.round((row.read / origin.source.pointCount) * size);
    await close();
  }
  return rows;
}

async function level(origin, strip, interval, spacing) {
  const before = process.cpuUsage();
  const line = new TerrainLine(0, strip.length, { interval, statistic: 50 });
  const place = new Float64Array(2);
  const { scale, offset } = origin;
  let [read, shown] = [0, 0];
  for await (const { records, inside } of origin.query({ volume: strip, spacing }).batches()) {
    read += records.count;
    shown += inside.length;
    for (const point of inside) {
      const [x, y, z] = [0, 1, 2].map((axis) => records.xyz[3 * point + axis] * scale[axis] + offset[axis]);
      strip.locate(x, y, place);
      line.add(place[0], z);
    }
  }
  const { user, system } = process.cpuUsage(before);
  return { spacing, read, shown, ms: (user + system) / 1000, stations: line.stations() };
}

function difference(stations, whole) {
  let [sum, count, missing] = [0, 0, 0];
  for (const [index, { height, count: own }] of stations.entries()) {
    if (whole[index].count === 0) continue;
    if (own === 0) missing++;
    else {
      sum += (height - whole[index].height) ** 2;
      count++;
    }
  }
  return { rms: Math.sqrt(sum / Math.max(1, count)), missing: missing / Math.max(1, missing + count) };
}

const LENGTHS = [100, 1e3, 1e4, 1e5];

/** Grid against geodesic chainage in UTM, by length and by distance of the line from the zone's meridian; lines to the north-east. */
export function measureChainage() {
  return [0, 1, 3].flatMap((away) =>
    LENGTHS.map((length) => {
      const utm = proj4("WGS84", "+proj=utm +zone=32 +datum=WGS84");
      const [longitude, latitude] = [(9 + away) * DEGREE, 47 * DEGREE];
      const end = geodesicFrom(longitude, latitude, 45 * DEGREE, length);
      const [x, y] = utm.forward([longitude / DEGREE, latitude / DEGREE]);
      const [ex, ey] = utm.forward([end.longitude / DEGREE, end.latitude / DEGREE]);
      return { line: `${away}° from the meridian`, length, grid: Math.hypot(ex - x, ey - y) - length };
    }),
  );
}

import { type AccuracyPart, pointTransform, resolveCrs, statedAccuracy, truthOf } from "@groma/georef";
import type { PointOrigin, QueryOptions } from "../../query/index.js";
import { type MeasuredCloud, recordVertex, type Vertex } from "./vertex/vertex.js";

export const UTM = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";

const PARTS: readonly AccuracyPart[] = [
  { name: "quantisation", metres: 0.0009 },
  { name: "fit", metres: 0.001 },
  { name: "datum operation", metres: 1, note: "some operation" },
  { name: "height", metres: null, note: "reference unknown, drawn as ellipsoidal" },
];

/** Of y, source units, so that millimetres of northings fit into the integers of LAS. */
const OFFSET = 4_000_000;

export interface FixtureCloud extends MeasuredCloud {
  /** A record whose integers are nearest to source coordinates. */
  vertex(x: number, y: number, z: number): Vertex;
}

/** A data set of any records, as far as measuring sees one. */
export function cloudOf(
  given: string,
  { name = "scan", parts = PARTS, scale = 0.001, vertical = undefined as string | undefined } = {},
): FixtureCloud {
  const crs = resolveCrs({ file: name, given, ...(vertical && { givenVertical: vertical }) });
  const transform = pointTransform(truthOf({ crs }, 0, name));
  const indices = new Map<string, number>();
  return {
    name,
    crs,
    scale: [scale, scale, scale],
    offset: [0, OFFSET, 0],
    accuracy: statedAccuracy(parts),
    bounds: { radius: 1000 },
    place(x: number, y: number, z: number) {
      const out = new Float64Array(3);
      transform(x, y, z, out, 0);
      return out;
    },
    vertex(x: number, y: number, z: number) {
      const integers = [
        Math.round(x / scale),
        Math.round((y - OFFSET) / scale),
        Math.round(z / scale),
      ] as const;
      const source = [integers[0] * scale, integers[1] * scale + OFFSET, integers[2] * scale] as const;
      const key = integers.join();
      const index = indices.get(key) ?? indices.size;
      indices.set(key, index);
      return recordVertex(this, { node: "0-0-0-0", index, integers, source });
    },
  };
}

/** Points with classes, metres from a place. */
export type Points = readonly (readonly [number, number, number, number])[];
/** Easting and northing. */
export const PLACE = [500000, 5300000] as const;
const [X, Y] = PLACE;

/** A data set of these points, in one node. */
export function withPoints(cloud: FixtureCloud, points: Points) {
  const integers = points.flatMap(([x, y, z]) => cloud.vertex(X + x, Y + y, z).record!.integers);
  const attribute = {
    name: "classification",
    bytes: Uint8Array.from(points, ([, , , kind]) => kind),
    at: 0,
    stride: 1,
  };
  const records = { count: points.length, xyz: Int32Array.from(integers), attributes: [attribute] };
  const query = ({ volume }: QueryOptions = {}) => ({
    bracket: async () => ({ least: 0, most: points.length, nodes: 1 }),
    async *batches() {
      const inside = points.flatMap(([x, y, z], i) => (volume?.contains(X + x, Y + y, z) ? [i] : []));
      yield {
        node: "0-0-0-0",
        key: { depth: 0, x: 0, y: 0, z: 0 },
        records,
        inside: Uint32Array.from(inside),
      };
    },
  });
  return Object.assign(cloud, { offset: [0, 4_000_000, 0], query }) as unknown as FixtureCloud & PointOrigin;
}

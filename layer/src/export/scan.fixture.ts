import { ROOT_KEY } from "../octree/index.js";
import type { PointOrigin, QueryOptions } from "../query/index.js";
import type { LasEnvelope } from "../sources/contract/point-source.js";
import type { StoredAttribute } from "../workers/index.js";

/** Integers of a point, its class and its colour. */
export interface FixturePoint {
  readonly xyz: readonly [number, number, number];
  readonly classification?: number;
  readonly colour?: readonly [number, number, number];
}

const RECORD = 36;
const SCALE = 0.01;

const attribute = (bytes: Uint8Array, name: string, type: "uint8" | "uint16", at: number) =>
  ({
    ...{ name, type, at, bytes, stride: RECORD, components: 1, scale: [1], offset: [0] },
    ...{ shift: 0, mask: -1, noData: undefined },
  }) as unknown as StoredAttribute;

/** A scan of LAS records of format 7, centimetres, in nodes of a few points. */
export function scanOf(points: readonly FixturePoint[], perNode = 3, name = "scan.copc.laz"): PointOrigin {
  const header = new Uint8Array(375);
  header.set(new TextEncoder().encode("LASF"));
  new DataView(header.buffer).setUint16(94, 375, true);
  for (const at of [131, 139, 147]) new DataView(header.buffer).setFloat64(at, SCALE, true);
  const envelope: LasEnvelope = { header, pointFormat: 7, recordLength: RECORD, records: [] };
  const nodes = Array.from({ length: Math.ceil(points.length / perNode) }, (_, node) =>
    nodeOf(points.slice(node * perNode, (node + 1) * perNode), node),
  );
  return {
    ...{ name, scale: [SCALE, SCALE, SCALE], offset: [0, 0, 0] },
    lasEnvelope: async () => envelope,
    query: ({ volume }: QueryOptions = {}) => ({
      bracket: async () => ({ least: 0, most: points.length, nodes: nodes.length }),
      async *batches() {
        for (const { records, ...node } of nodes) {
          const { xyz } = records;
          const inside = Uint32Array.from({ length: records.count }, (_, index) => index).filter((index) => {
            const [x, y, z] = xyz.subarray(3 * index, 3 * index + 3);
            return volume?.contains(x * SCALE, y * SCALE, z * SCALE) ?? true;
          });
          if (inside.length > 0) yield { ...node, records, inside };
        }
      },
    }),
  };
}

function nodeOf(points: readonly FixturePoint[], number: number) {
  const lasRecords = new Uint8Array(RECORD * points.length);
  const view = new DataView(lasRecords.buffer);
  const xyz = new Int32Array(3 * points.length);
  for (const [index, { xyz: place, classification = 0, colour = [0, 0, 0] }] of points.entries()) {
    xyz.set(place, 3 * index);
    const at = RECORD * index;
    for (const axis of [0, 1, 2]) {
      view.setInt32(at + 4 * axis, place[axis], true);
      view.setUint16(at + 30 + 2 * axis, colour[axis], true);
    }
    view.setUint8(at + 14, 0x11);
    view.setUint8(at + 16, classification);
  }
  const attributes = [
    attribute(lasRecords, "classification", "uint8", 16),
    ...["red", "green", "blue"].map((name, axis) => attribute(lasRecords, name, "uint16", 30 + 2 * axis)),
  ];
  const records = { count: points.length, xyz, attributes, lasRecords };
  return { node: `0-${number}-0-0`, key: ROOT_KEY, records };
}

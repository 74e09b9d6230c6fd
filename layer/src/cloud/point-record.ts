import { FormatError } from "../errors/index.js";
import type { PointSource } from "../sources/contract/point-source.js";
import { exactValue, type NodeRecords } from "../workers/index.js";
import type { PointRecord, RecordValue } from "./attribute-info.js";

/** Reads one point out of a node's records, exactly as it is recorded. */
export function pointRecord(
  node: string,
  index: number,
  { xyz, attributes: stored }: Pick<NodeRecords, "xyz" | "attributes">,
  { scale, offset }: Pick<PointSource, "scale" | "offset">,
): PointRecord {
  const integers = [0, 1, 2].map((axis) => xyz[3 * index + axis]) as [number, number, number];
  const source = integers.map((value, axis) => value * scale[axis] + offset[axis]) as [
    number,
    number,
    number,
  ];
  // Names are the file's own: one may be that of what all objects inherit.
  const attributes: Record<string, RecordValue> = Object.create(null);
  for (const attribute of stored) {
    const values = Array.from({ length: attribute.components }, (_, component) =>
      exactValue(attribute, index, component),
    );
    attributes[attribute.name] = attribute.components === 1 ? values[0] : values;
  }
  return { node, index, integers, source, attributes };
}

/**
 * Index of a point's record in its node's chunk.
 * @param point how many-th point in drawing order, or that index itself
 * @param order indices of the records in drawing order
 * @throws FormatError FORMAT_NODE where the node has no such point
 */
export function recordIndex(
  point: number | { readonly record: number },
  order: NodeRecords["order"],
  { node, file }: { readonly node: string; readonly file: string },
): number {
  const index = typeof point === "number" ? order[point] : point.record;
  if (index !== undefined && index in order) return index;
  throw new FormatError({
    code: "FORMAT_NODE",
    file,
    cause: `node ${node} has no point ${typeof point === "number" ? point : point.record}`,
    fix: `Ask for a point from 0 to ${order.length - 1}`,
  });
}

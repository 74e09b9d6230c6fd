import type { LasHeader } from "../sources/index.js";
import { exactValue, type NodeRecords, type RecordField } from "../workers/index.js";
import type { PointRecord, RecordValue } from "./attribute-info.js";

/** Reads one point out of a node's plain records, exactly as it is recorded. */
export function pointRecord(
  node: string,
  index: number,
  { bytes }: Pick<NodeRecords, "bytes">,
  { recordLength, scale, offset }: Pick<LasHeader, "recordLength" | "scale" | "offset">,
  fields: readonly RecordField[],
): PointRecord {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const record = index * recordLength;
  const integers = [0, 4, 8].map((at) => view.getInt32(record + at, true)) as [number, number, number];
  const source = integers.map((value, axis) => value * scale[axis] + offset[axis]) as [
    number,
    number,
    number,
  ];
  const attributes: Record<string, RecordValue> = {};
  for (const field of fields) {
    const values = Array.from({ length: field.components }, (_, component) =>
      exactValue(view, record, field, component),
    );
    attributes[field.name] = field.components === 1 ? values[0] : values;
  }
  return { node, index, integers, source, attributes };
}

import { MeasureError } from "../../../errors/index.js";
import type { Measurement } from "../measurement/measurement.js";
import { datasetAmong } from "../vertex/dataset.js";
import type { RecordedPoint } from "../vertex/vertex.js";

/** A data set whose records can be read; a `PointCloud` is one. */
export interface ReadableCloud {
  readonly name: string;
  readonly identity?: string | undefined;
  readPoint(
    node: string,
    point: { readonly record: number },
    options: { signal?: AbortSignal | undefined },
  ): Promise<RecordedPoint>;
}

/**
 * Holds vertices against the records that they say they stand on.
 * @throws MeasureError MEASURE_RECORD where a record has other integers: the scan was converted again, or is another one
 * @throws FormatError FORMAT_NODE where there is no such record; SourceError, DecodeError; the signal's reason when aborted
 */
export async function verifyRecords(
  measurements: readonly Measurement[],
  clouds: readonly ReadableCloud[],
  { signal }: { signal?: AbortSignal | undefined } = {},
): Promise<void> {
  for (const { name, vertices } of measurements) {
    for (const [i, { record, source: stood }] of vertices.entries()) {
      const cloud = record && datasetAmong(clouds, record);
      if (!cloud) continue;
      const read = await cloud.readPoint(record.node, { record: record.index }, { signal });
      const same = read.integers.every((value, axis) => value === record.integers[axis]);
      // What it was measured by is compared too: the record may be there, and the vertex elsewhere.
      const there = !stood || read.source.every((value, axis) => isClose(value, stood[axis]));
      if (same && there) continue;
      throw new MeasureError({
        code: "MEASURE_RECORD",
        file: record.dataset,
        cause: `record ${record.index} of node ${record.node} is not the one that vertex ${i + 1} of ${name} was measured on`,
        fix: "open the file that the measurement was made in, or place the vertex again",
      });
    }
  }
}

function isClose(a: number, b: number): boolean {
  return Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(a));
}

import { type Domain, fitPlacement, placeIntegers, type Truth, truthOf } from "@groma/georef";
import { badChunk } from "./chunk-layout.js";
import type { LazDecoder } from "./laz-decoder.js";
import { packVertices, positionBox } from "./pack.js";
import type { DataSetSpec, NodeJob, NodeVertices } from "./protocol.js";
import { integerBox, readRecords, valueRange } from "./records.js";

/** A data set with the map of its coordinates to ECEF, which is made once. */
export interface PreparedDataSet {
  readonly spec: DataSetSpec;
  readonly truth: Truth;
}

/** Makes the map of a data set. @throws CrsError, RecordError */
export function prepareDataSet(spec: DataSetSpec): PreparedDataSet {
  return { spec, truth: truthOf(spec, (spec.heights[0] + spec.heights[1]) / 2, spec.file) };
}

/**
 * Carries out one node's work: decode, place, pack.
 * @throws DecodeError, PlacementError
 */
export async function runNodeJob(
  dataSet: PreparedDataSet,
  job: NodeJob,
  decoder: LazDecoder,
): Promise<NodeVertices> {
  const { spec, truth } = dataSet;
  const { pointFormat, recordLength, scale, offset, file } = spec;
  const chunk = new Uint8Array(job.chunk);
  const bytes = await decoder.decode(chunk, pointFormat, recordLength, job.pointCount, file, job.node);
  const records = readRecords(bytes, pointFormat, recordLength);
  const domain = sourceBox(integerBox(records), spec);
  checkInCube(domain, job, spec);
  const placement = fitPlacement(truth, domain, spec.tolerance, file);
  const positions = new Float32Array(3 * records.count);
  placeIntegers(placement, records.xyz, records.count, scale, offset, positions);
  const colour = valueRange(records.rgb);
  const intensity = valueRange(records.intensity);
  const vertices = packVertices(positions, records, {
    rgbBits: job.rgbBits ?? (colour.max > 255 ? 16 : 8),
    lowest: (spec.heights[0] - offset[2]) / scale[2],
    highest: (spec.heights[1] - offset[2]) / scale[2],
  });
  return {
    vertices,
    count: records.count,
    frame: placement.frame,
    box: positionBox(positions),
    bound: placement.bound,
    scheme: placement.scheme,
    seen: { colourMax: colour.max, intensityMin: intensity.min, intensityMax: intensity.max },
  };
}

/** Box of LAS integers in source coordinates. */
function sourceBox(box: Int32Array, { scale, offset }: DataSetSpec): Domain {
  const at = (index: number) => box[index] * scale[index % 3] + offset[index % 3];
  return { minX: at(0), minY: at(1), minZ: at(2), maxX: at(3), maxY: at(4), maxZ: at(5) };
}

/**
 * Damaged chunks often decode, to points all over the place. A node's points lie in its cube; a hundredth of
 * its edge is left to writers that round differently.
 */
function checkInCube(domain: Domain, job: NodeJob, spec: DataSetSpec): void {
  const [x, y, z, edge] = job.cube;
  const outside = (least: number, greatest: number, from: number, axis: number) => {
    const slack = 0.01 * edge + 2 * spec.scale[axis];
    return least < from - slack || greatest > from + edge + slack;
  };
  if (
    outside(domain.minX, domain.maxX, x, 0) ||
    outside(domain.minY, domain.maxY, y, 1) ||
    outside(domain.minZ, domain.maxZ, z, 2)
  ) {
    throw badChunk(spec.file, job.node, "they lie outside their node");
  }
}

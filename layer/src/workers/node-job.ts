import {
  aroundPoints,
  type Domain,
  eastNorthUp,
  fitPlacement,
  levelFrame,
  type Placement,
  type PointTransform,
  placeIntegers,
  pointTransform,
  recordedTruth,
  type Truth,
  truthOnWebMercator,
} from "@groma/georef";
import { badChunk } from "./chunk-layout.js";
import { cubeMap, localOf } from "./cube-map.js";
import { type Decoders, decode } from "./decoders.js";
import { drawingOrder } from "./drawing-order.js";
import { onGlobe } from "./globe-map.js";
import { cellGrid } from "./morton-sort.js";
import { makeArrays } from "./node-columns.js";
import { checkNodeSize } from "./node-size.js";
import { reachOf, stepBound, stepOver, toSteps } from "./position-steps.js";
import type {
  ChunkJob,
  DataSetSpec,
  NodeJob,
  NodeRecords,
  NodeVertices,
  RecordedNode,
  StorageSpec,
} from "./protocol.js";
import { integerBox, positionBox } from "./records.js";

/** A data set with the map of its coordinates to ECEF or to the plane of a map, which is made once. */
export interface PreparedDataSet {
  readonly spec: DataSetSpec;
  readonly truth: Truth;
  /** Source coordinates → ECEF, of a data set that is placed on a map. */
  readonly globe?: PointTransform;
}

/** What brings the projections that a data set may need; called only then. */
export type LoadProjections = () => Promise<typeof import("./projections.js")>;

/** Makes the map of a data set. @throws CrsError, RecordError; what keeps the projections away */
export async function prepareDataSet(
  spec: DataSetSpec,
  projections: LoadProjections,
): Promise<PreparedDataSet> {
  const { plane, heights, file, crs } = spec;
  const middle = (heights[0] + heights[1]) / 2;
  const recorded = recordedTruth(spec, file);
  if (recorded && !plane) return { spec, truth: recorded };
  const { size } = crs.verticalUnit;
  const known = recorded && plane && truthOnWebMercator(recorded, plane, middle, size, file);
  if (known) return { spec, truth: known, globe: pointTransform(recorded) };
  const { truthOf, truthOnMap } = await projections();
  const truth = recorded ?? truthOf(spec, middle, file);
  if (!plane) return { spec, truth };
  const onMap = truthOnMap(truth, plane, middle, size, file);
  return { spec, truth: onMap, globe: pointTransform(truth) };
}

/** The same once, for all jobs; what keeps it away is told to each of them, and the next one tries again. */
export function preparedOnce(
  spec: DataSetSpec,
  projections: LoadProjections,
): () => Promise<PreparedDataSet> {
  let prepared: Promise<PreparedDataSet> | undefined;
  return () => {
    prepared ??= prepareDataSet(spec, projections).catch((thrown: unknown) => {
      prepared = undefined;
      throw thrown;
    });
    return prepared;
  };
}

/**
 * Carries out one node's work: decode, order, place, pack.
 * @throws DecodeError, PlacementError
 */
export async function runNodeJob(
  { spec, truth, globe }: PreparedDataSet,
  job: NodeJob,
  decoders: Decoders,
): Promise<NodeVertices> {
  const { xyz, count, order, attributes } = inDrawingOrder(await decodeChunk(spec, job, decoders), job, spec);
  const box = integerBox(xyz);
  const domain = sourceBox(box, spec);
  checkInCube(domain, job, spec);
  const frameAt = spec.plane ? levelFrame : eastNorthUp;
  const { scale, offset, tolerance } = spec;
  const fit = (tolerance: number) => fitPlacement(truth, domain, tolerance, spec.file, frameAt);
  const fitted = withRoomForSteps(fit, tolerance);
  const placement = aroundPoints(fitted, { xyz, count }, scale, offset, tolerance, frameAt);
  const { frame, bound: placed, scheme } = placement;
  const place = (positions: Float32Array) => {
    placeIntegers(placement, drawn(xyz, order), count, scale, offset, positions);
  };
  const heights = [box[2], box[5]] as const;
  const points = { xyz, count, order, heights, frame, bound: placed, place };
  const arrays = makeArrays(spec, attributes, points, job.appearance);
  const step = stepWithin(tolerance, placed, arrays.positions);
  // Heights are of the places as they were before.
  if (step) toSteps(arrays.positions, step);
  const bound = placed + (step ? stepBound(step) : 0);
  const local = positionBox(arrays.positions);
  const { minX, minY, minZ, maxX, maxY, maxZ } = domain;
  return {
    ...arrays,
    ...{ count, frame, bound, step, scheme, box: local, bytes: arrays.buffer.byteLength },
    extent: Float64Array.of(minX, minY, minZ, maxX, maxY, maxZ),
    ...cubeMap(placement, job.cube, spec, { xyz, order }, arrays.positions, local),
    ...(globe && { onGlobe: onGlobe(globe, placement, domain, job.cube[3]) }),
  };
}

/**
 * A fit that leaves of the tolerance what positions at whole steps take, where there is one that needs no projection of each
 * point; else the cheapest.
 */
function withRoomForSteps(fit: (tolerance: number) => Placement, tolerance: number): Placement {
  const cheapest = fit(tolerance);
  const { minX, minY, minZ, maxX, maxY, maxZ } = cheapest.domain;
  const corners = [minX, maxX].flatMap((x) =>
    [minY, maxY].flatMap((y) => [minZ, maxZ].flatMap((z) => localOf(cheapest, [x, y, z]))),
  );
  const taken = stepBound(stepOver(reachOf(corners)));
  // Those that project each point are as good as can be.
  if (cheapest.bound + taken <= tolerance || taken >= tolerance || cheapest.scheme === "exact")
    return cheapest;
  const closer = fit(tolerance - taken);
  return closer.scheme !== "exact" && closer.bound + taken <= tolerance ? closer : cheapest;
}

/** The step that positions can be moved to without leaving the tolerance; undefined where there is none. */
function stepWithin(tolerance: number, bound: number, positions: Float32Array): number | undefined {
  const step = stepOver(reachOf(positionBox(positions)));
  return bound + stepBound(step) <= tolerance ? step : undefined;
}

/**
 * A node's points as they are recorded, with the order in which they are drawn.
 * @throws DecodeError
 */
export async function runRecordsJob(
  { spec }: PreparedDataSet,
  job: ChunkJob,
  decoders: Decoders,
): Promise<NodeRecords> {
  return inDrawingOrder(await decodeNode(spec, job, decoders), job, spec);
}

/**
 * A node's points as they are recorded.
 * @throws DecodeError
 */
export async function decodeNode(
  spec: StorageSpec,
  job: Omit<ChunkJob, "dataSet">,
  decoders: Decoders,
): Promise<RecordedNode> {
  const records = await decodeChunk(spec, job, decoders);
  checkInCube(sourceBox(integerBox(records.xyz), spec), job, spec);
  return records;
}

async function decodeChunk(
  { encoding, file, bytesPerPoint }: StorageSpec,
  { chunk, checksum, pointCount, node }: Omit<ChunkJob, "dataSet">,
  decoders: Decoders,
): Promise<RecordedNode> {
  checkNodeSize({ file, node, pointCount, bytesPerPoint });
  const expected = { pointCount, checksum, file, node };
  const decoded = await decode(decoders, new Uint8Array(chunk), encoding, expected);
  return { ...decoded, count: decoded.xyz.length / 3 };
}

function inDrawingOrder(
  records: RecordedNode,
  { cube }: Pick<ChunkJob, "cube">,
  { scale, offset }: StorageSpec,
): NodeRecords {
  const { xyz, count } = records;
  return { ...records, order: drawingOrder(xyz, count, cellGrid(cube, scale, offset)) };
}

/** Coordinates in drawing order. */
function drawn(xyz: Int32Array, order: ArrayLike<number>): Int32Array {
  const sorted = new Int32Array(xyz.length);
  for (let point = 0, to = 0; to < sorted.length; point++, to += 3) {
    const from = 3 * order[point];
    sorted[to] = xyz[from];
    sorted[to + 1] = xyz[from + 1];
    sorted[to + 2] = xyz[from + 2];
  }
  return sorted;
}

/** Box of LAS integers in source coordinates. */
function sourceBox(box: Int32Array, { scale, offset }: StorageSpec): Domain {
  const at = (index: number) => box[index] * scale[index % 3] + offset[index % 3];
  return { minX: at(0), minY: at(1), minZ: at(2), maxX: at(3), maxY: at(4), maxZ: at(5) };
}

/**
 * How far a point may lie outside its node's cube, source units: a hundredth of the edge is left to writers that round
 * differently.
 * @param scale source units per step of the recorded integers
 */
export function cubeSlack(edge: number, scale: number): number {
  return 0.01 * edge + 2 * scale;
}

/** Damaged chunks often decode, to points all over the place, whereas a node's points lie in its cube. */
function checkInCube(domain: Domain, job: Pick<ChunkJob, "cube" | "node">, spec: StorageSpec): void {
  const [x, y, z, edge] = job.cube;
  const outside = (least: number, greatest: number, from: number, axis: number) => {
    const slack = cubeSlack(edge, spec.scale[axis]);
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

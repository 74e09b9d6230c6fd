import {
  type Crs,
  ecefToGeodetic,
  geodeticToEcef,
  PlacementError,
  type StatedAccuracy,
  type Vector,
} from "@groma/georef";
import { MeasureError } from "../../../errors/index.js";
import { type DatasetName, datasetAmong, datasetOf } from "./dataset.js";

/** What measuring must know of a data set; a `PointCloud` is one. */
export interface MeasuredCloud {
  readonly name: string;
  /** What tells its points from those of others of the same name. */
  readonly identity?: string | undefined;
  readonly crs: Crs;
  /** Source units per step of the recorded integers, per axis. */
  readonly scale: readonly [number, number, number];
  /** Source units, per axis: source coordinate = integer · scale + offset. */
  readonly offset?: readonly [number, number, number] | undefined;
  /** What a place is worth: named parts, metres. */
  readonly accuracy: StatedAccuracy;
  /** Sphere around all points; radius in metres. */
  readonly bounds: { readonly radius: number };
  /** Source coordinates → ECEF, exact, metres. @throws PlacementError PLACE_DOMAIN */
  place(x: number, y: number, z: number): ArrayLike<number>;
}

/** The record of a scan that a vertex stands on. */
export interface VertexRecord {
  /** Name of the data set. */
  readonly dataset: string;
  /** That of the data set: undefined where it has none, or a file of an earlier version does not say. */
  readonly identity?: string | undefined;
  /** Node, `depth-x-y-z`. */
  readonly node: string;
  /** Index of the record in the node's chunk. */
  readonly index: number;
  /** x, y, z as LAS integers. */
  readonly integers: readonly [number, number, number];
}

/** A point that is measured: the record it stands on, if any, and the places derived from it. */
export interface Vertex {
  /** Undefined for a place that is no record. */
  readonly record?: VertexRecord | undefined;
  /** The data set that `record` or `source` belong to; undefined where it is not at hand. */
  readonly cloud?: MeasuredCloud | undefined;
  /** What is known of that data set where it is not at hand and the vertex is no record. */
  readonly dataset?: DatasetName | undefined;
  /** x, y, z in the units of the data set's coordinate system. */
  readonly source?: Vector | undefined;
  /** EPSG:4978, metres. */
  readonly ecef: Vector;
  /** Of WGS 84, radians. */
  readonly longitude: number;
  readonly latitude: number;
  /** Above the ellipsoid, metres. */
  readonly height: number;
}

/** A record as `PointCloud.readPoint` and `layer.pick` give it. */
export interface RecordedPoint {
  readonly node: string;
  readonly index: number;
  readonly integers: readonly [number, number, number];
  readonly source: Vector;
}

/** A vertex on a recorded point. It stays that point whatever view, level of detail or fit. */
export function recordVertex(cloud: MeasuredCloud, point: RecordedPoint): Vertex {
  const { node, index, integers, source } = point;
  const record = { ...datasetOf(cloud), node, index, integers };
  return { ...placed(cloud.place(...source)), record, cloud, source };
}

/**
 * A vertex at a place of a data set where no point need be.
 * @param source x, y, z in the units of its coordinate system
 * @throws PlacementError PLACE_DOMAIN
 */
export function sourceVertex(cloud: MeasuredCloud, source: Vector): Vertex {
  return { ...placed(cloud.place(...source)), cloud, source };
}

/** Whether two vertices stand on one record: one with other integers is another one, whatever else is said of it. */
export function isSameRecord({ record: a }: Vertex, { record: b }: Vertex): boolean {
  if (a === undefined || b === undefined) return false;
  return (
    a === b ||
    (a.index === b.index &&
      a.node === b.node &&
      a.dataset === b.dataset &&
      a.identity === b.identity &&
      a.integers.every((value, axis) => value === b.integers[axis]))
  );
}

const keys = new WeakMap<object, string>();

/** The same for vertices on one record; a vertex that is none has its own. */
export function recordKey(vertex: Vertex): unknown {
  const { record } = vertex;
  if (!record) return vertex;
  let key = keys.get(record);
  if (key === undefined) {
    const { dataset, identity, node, index, integers } = record;
    key = JSON.stringify([dataset, identity, node, index, integers]);
    keys.set(record, key);
  }
  return key;
}

/**
 * A vertex with the data set that it stands on, where that is among those at hand: its place is that set's own, and the
 * record stays what it was. It stays as it is where that data set, as it is open, has no such place.
 */
export function attached(vertex: Vertex, clouds: readonly MeasuredCloud[]): Vertex {
  const { record, source } = vertex;
  const named = datasetNameOf(vertex);
  const cloud = named && datasetAmong(clouds, named);
  if (!cloud || !source || cloud === vertex.cloud) return vertex;
  try {
    return record ? recordVertex(cloud, { ...record, source }) : sourceVertex(cloud, source);
  } catch (thrown) {
    if (thrown instanceof PlacementError) return vertex;
    throw thrown;
  }
}

/** The data set that a vertex belongs to, at hand or not. */
export function datasetNameOf({ record, cloud, dataset }: Vertex): DatasetName | undefined {
  return record ?? (cloud ? datasetOf(cloud) : dataset);
}

/**
 * A vertex that belongs to no data set.
 * @param longitude of WGS 84, radians, as `latitude`
 * @param height above the ellipsoid, metres
 * @throws MeasureError MEASURE_OPTION for numbers that are none, and for latitudes beyond the poles
 */
export function placeVertex(longitude: number, latitude: number, height: number): Vertex {
  if (![longitude, latitude, height].every(Number.isFinite)) {
    throw noPlace(`${longitude}, ${latitude}, ${height} are no longitude, latitude and height`);
  }
  if (Math.abs(latitude) > Math.PI / 2 + ROUNDING || Math.abs(longitude) > MOST_LONGITUDE) {
    throw noPlace(`longitude ${longitude}, latitude ${latitude} are no radians`);
  }
  const ecef = new Float64Array(3);
  geodeticToEcef(longitude, latitude, height, ecef);
  return { longitude, latitude, height, ecef: [ecef[0], ecef[1], ecef[2]] };
}

/** Of a latitude, radians. */
const ROUNDING = 1e-12;

/** Radians: one turn and a half, as data across the antimeridian have them. */
const MOST_LONGITUDE = 3 * Math.PI + ROUNDING;

function noPlace(cause: string): MeasureError {
  return new MeasureError({
    code: "MEASURE_OPTION",
    file: "vertex",
    cause,
    fix: "give longitude and latitude of WGS 84 in radians and the height in metres, or ECEF in metres",
  });
}

/** The same from ECEF, metres. @throws MeasureError MEASURE_OPTION for numbers that are none */
export function ecefVertex(ecef: ArrayLike<number>): Vertex {
  if (![ecef[0], ecef[1], ecef[2]].every(Number.isFinite)) {
    throw noPlace(`${[ecef[0], ecef[1], ecef[2]].join(", ")} are no X, Y and Z`);
  }
  return placed(ecef);
}

function placed(ecef: ArrayLike<number>): Vertex {
  const geodetic = new Float64Array(3);
  ecefToGeodetic(ecef[0], ecef[1], ecef[2], geodetic);
  const [longitude, latitude, height] = geodetic;
  return { longitude, latitude, height, ecef: [ecef[0], ecef[1], ecef[2]] };
}

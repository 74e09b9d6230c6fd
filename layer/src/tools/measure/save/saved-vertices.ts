import { PlacementError, type Vector } from "@groma/georef";
import { HEIGHTS } from "../../../camera/index.js";
import { isObject } from "../measurement/volume-settings.js";
import { type DatasetName, datasetAmong, whyNotAmong } from "../vertex/dataset.js";
import {
  type MeasuredCloud,
  placeVertex,
  recordVertex,
  sourceVertex,
  type Vertex,
} from "../vertex/vertex.js";

/** Where the integers of LAS end. */
const INTEGERS = 2 ** 31;

/** Degrees. */
const MOST_LONGITUDE = 540;

/** Reads vertices of files, and puts them onto the data sets that are open. */
export class SavedVertices {
  readonly #open: readonly MeasuredCloud[];
  /** Data sets as the file has them, by their names and identities. */
  readonly #saved: ReadonlyMap<string, Readonly<Record<string, unknown>>>;
  readonly #notes: Set<string>;

  /**
   * @param saved the member `datasets` of the file
   * @param notes take up what has to be known, in English
   */
  constructor(open: readonly MeasuredCloud[], saved: unknown, notes: Set<string>) {
    this.#open = open;
    this.#saved = new Map(
      (Array.isArray(saved) ? saved.filter(isObject) : []).map((one) => [key(one.name, one.identity), one]),
    );
    this.#notes = notes;
  }

  /** A vertex as it is saved; undefined where it has no place. */
  vertex(saved: unknown): Vertex | undefined {
    if (!isObject(saved)) return undefined;
    const { dataset, identity, source, place } = saved;
    const there = placeOf(place);
    if (!there || typeof dataset !== "string") return there;
    const named = { dataset, ...(typeof identity === "string" && { identity }) };
    const found = recordOf(saved);
    const record = found && { ...named, ...found };
    if (!record && (saved.node !== undefined || saved.integers !== undefined)) {
      this.#notes.add(`what ${dataset} is said to have as a record is none: that vertex is a place`);
    }
    if (!isTriple(source)) return there;
    const kept = { ...there, source, ...(record ? { record } : { dataset: named }) };
    const cloud = this.#cloudOf(named);
    if (!cloud) return kept;
    try {
      if (!record) return sourceVertex(cloud, source);
      // The integers are what was recorded; the rest is derived.
      const exact = sourceOf(cloud, record.integers) ?? source;
      const same = exact.every((value, axis) => Math.abs(value - source[axis]) <= cloud.scale[axis] / 2);
      if (!same)
        this.#notes.add(`source coordinates of ${dataset} are not those of its integers, which count`);
      return recordVertex(cloud, { ...record, source: exact });
    } catch (thrown) {
      if (!(thrown instanceof PlacementError)) throw thrown;
      this.#notes.add(
        `${dataset} has no place for some vertices as it is open: they stand at their saved places`,
      );
      return kept;
    }
  }

  /** The data set that is meant, if it is open and the one that was measured. */
  #cloudOf(named: DatasetName): MeasuredCloud | undefined {
    const cloud = datasetAmong(this.#open, named);
    const why = cloud ? this.#mismatch(cloud, named) : whyNotAmong(this.#open, named);
    if (why === undefined) return cloud;
    this.#notes.add(`${why}: its vertices stand at their saved places`);
    return undefined;
  }

  /** Why a data set of the name may be another one, where the file tells no more than names. */
  #mismatch(cloud: MeasuredCloud, { dataset, identity }: DatasetName): string | undefined {
    const saved = this.#saved.get(key(dataset, identity));
    if (identity !== undefined || !saved) return undefined;
    const { scale, crs } = saved;
    const sameScale = !isTriple(scale) || scale.every((step, axis) => step === cloud.scale[axis]);
    if (!sameScale) return `the ${dataset} that is open has another scale than the one that was measured`;
    const sameCrs = !isObject(crs) || typeof crs.proj4 !== "string" || crs.proj4 === cloud.crs.proj4;
    return sameCrs ? undefined : `${dataset} was measured in ${crs.name} and is open in ${cloud.crs.name}`;
  }
}

/** A place of no data set. @param position longitude, latitude in degrees, height in metres, 0 where it is not given */
export function placeOf(position: unknown): Vertex | undefined {
  if (!Array.isArray(position)) return undefined;
  const [longitude, latitude, given] = position;
  const height = given ?? 0;
  if (![longitude, latitude, height].every(Number.isFinite)) return undefined;
  if (Math.abs(latitude) > 90 || Math.abs(longitude) > MOST_LONGITUDE) return undefined;
  if (height < HEIGHTS[0] || height > HEIGHTS[1]) return undefined;
  return placeVertex((longitude * Math.PI) / 180, (latitude * Math.PI) / 180, height);
}

function key(name: unknown, identity: unknown): string {
  return JSON.stringify([name, identity ?? null]);
}

function sourceOf({ scale, offset }: MeasuredCloud, integers: Vector): Vector | undefined {
  if (!offset) return undefined;
  const [x, y, z] = integers.map((value, axis) => value * scale[axis] + offset[axis]);
  return [x, y, z];
}

/** What of a saved vertex says which record it is; undefined where that is none of LAS in an octree. */
function recordOf({ node, index, integers }: Readonly<Record<string, unknown>>) {
  if (typeof node !== "string" || !/^\d+-\d+-\d+-\d+$/.test(node)) return undefined;
  if (typeof index !== "number" || !Number.isInteger(index) || index < 0) return undefined;
  const inLas = (value: number) => Number.isInteger(value) && value >= -INTEGERS && value < INTEGERS;
  return isTriple(integers) && integers.every(inLas) ? { node, index, integers } : undefined;
}

function isTriple(value: unknown): value is [number, number, number] {
  return Array.isArray(value) && value.length === 3 && value.every(Number.isFinite);
}

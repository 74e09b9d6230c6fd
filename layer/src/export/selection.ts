import type { Crs } from "@groma/georef";
import { Pace, type PointBatch, type QueryVolume, type RecordQuery } from "../query/index.js";
import { passing, type WantedPoints } from "./passing.js";

/** How points lie along a line: what a profile adds to their records. */
export interface AlongLine {
  /** x and y of its vertices: source coordinates, or those of the plane that `toPlane` leads to. */
  readonly vertices: readonly (readonly [number, number])[];
  /** Chainage of each. */
  readonly chainages: readonly number[];
  /**
   * @param out receives the chainage (distance along the line) and the signed offset from it, left positive
   * @param z without a part in it where the line lies in the plane of the coordinates
   */
  locate(x: number, y: number, out: Float64Array, z?: number): void;
  /** Where source coordinates are in the plane of its vertices: x and y, written to `out`. Default: that is their own plane. */
  toPlane?(x: number, y: number, z: number, out: Float64Array): void;
}

/** Points that are written to one file. */
export interface PointSelection extends WantedPoints {
  /** Part of space, source coordinates. Default: everything. */
  readonly volume?: QueryVolume | undefined;
  /** Distance between neighbouring points that suffices; as `QueryOptions.spacing`. Default: 0, every point. */
  readonly spacing?: number | undefined;
  /** The system of its coordinates, which tells several data sets apart. Default: the one that a `PointCloud` has. */
  readonly crs?: Crs | undefined;
  /** The line along which the points were cut. */
  readonly along?: AlongLine | undefined;
}

/** A volume of several parts, which may overlap. */
export interface PartedVolume extends QueryVolume {
  /** Number of parts. */
  readonly count: number;
  /**
   * @param out receives the numbers of the parts that a point lies in, rising
   * @returns how many they are
   */
  partsAt(x: number, y: number, z: number, out: Uint32Array): number;
}

/** Points of several parts of one data set, of which each is written to files of its own. */
export interface PartedSelection extends Omit<PointSelection, "volume" | "along"> {
  readonly volume: PartedVolume;
}

/** How far an export is. */
export interface ExportProgress {
  /** Points that were read so far. */
  readonly read: number;
  /** Points of all nodes that are read. */
  readonly total: number;
  /** Points that were written so far. */
  readonly written: number;
}

/** What every export may be given. */
export interface ExportOptions {
  /** Stops it; what is asked for ends with the signal's reason. */
  readonly signal?: AbortSignal | undefined;
  /** Told after each node. */
  readonly onProgress?: ((progress: ExportProgress) => void) | undefined;
  /** Told of nodes whose points lie where points are wanted, and of which classes and filter leave none. */
  readonly onLeftOut?: ((batch: PointBatch) => void) | undefined;
}

/** Points that are handed over at a time: what writers make of so many takes some milliseconds. */
const SLICE = 1024;

/** Indices of a batch's records that are wanted, rising; at most {@link SLICE}. */
type Wanted = Uint32Array;

/**
 * Goes through the points of selections, one after the other, node by node in a fixed order, and hands over those that
 * are wanted: some at a time, between which others have the thread and the signal is heard.
 * @param take writes them; called several times for a node with many points
 * @returns number of points handed over
 * @throws SourceError, FormatError, DecodeError; the signal's reason when aborted; what `take` throws
 */
export async function eachBatch(
  selections: readonly PointSelection[],
  { signal, onProgress, onLeftOut }: ExportOptions,
  take: (batch: PointBatch, wanted: Wanted, selection: PointSelection) => Promise<void>,
): Promise<number> {
  const queries: { readonly query: RecordQuery; readonly selection: PointSelection }[] = [];
  let [read, total, written] = [0, 0, 0];
  for (const selection of selections) {
    const query = selection.origin.query({ volume: selection.volume, spacing: selection.spacing });
    total += (await query.bracket({ signal })).most;
    queries.push({ query, selection });
  }
  onProgress?.({ read, total, written });
  const pace = new Pace(signal);
  for (const { query, selection } of queries) {
    for await (const batch of query.batches({ signal })) {
      const before = written;
      for (let from = 0; from < batch.inside.length; from += SLICE) {
        const wanted = passing({ ...batch, inside: batch.inside.subarray(from, from + SLICE) }, selection);
        if (wanted.length > 0) await take(batch, wanted, selection);
        written += wanted.length;
        await pace.rest();
      }
      if (written === before) onLeftOut?.(batch);
      read += batch.records.count;
      onProgress?.({ read, total, written });
    }
  }
  onProgress?.({ read: total, total, written });
  return written;
}

/** The spacing at which points were left out, which files of them name; 0 where none were. */
export function spacingOf(selections: readonly PointSelection[]): number {
  return Math.max(0, ...selections.map(({ spacing }) => spacing ?? 0));
}

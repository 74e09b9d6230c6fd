import { count } from "../output.js";
import type { Planned } from "./bring.js";
import type { Pdal } from "./find.js";
import { asideName } from "./form.js";

/** What was read through PDAL and what became of its numbers, for machines. */
export interface PdalReport {
  readonly input: string;
  readonly points: number;
  readonly version: string;
  readonly readers: readonly string[];
  readonly streamed: boolean;
  readonly scale: readonly [number, number, number];
  readonly offset: readonly [number, number, number];
  /** Attributes that keep what LAS's own fields cannot hold. */
  readonly keptAside: readonly string[];
  /** Dimensions that became whole numbers. */
  readonly rounded: readonly string[];
  readonly tempBytes: number;
}

export function pdalReport({ version }: Pdal, { probe, form, bytes }: Planned): PdalReport {
  const { points, readers, streamed, job } = probe;
  const { scale, offset, rounded } = form;
  const keptAside = form.keptAside.map(asideName);
  return {
    input: job.name,
    points,
    version,
    readers,
    streamed,
    scale,
    offset,
    keptAside,
    rounded,
    tempBytes: bytes,
  };
}

/** A line for people, and one for each thing that has to be known. */
export function pdalInWords(report: PdalReport): string[] {
  const { input, points, version, readers, scale, keptAside, rounded } = report;
  const [x, , z] = scale;
  const steps = x === z ? `${x}` : `${x} in plane and ${z} in height`;
  const half = x === z ? `${x / 2}` : `${x / 2} and ${z / 2}`;
  return [
    `${input}: ${count(points)} points by PDAL ${version} (${readers.join(", ")}), coordinates in steps of ${steps}: rounded by at most ${half}`,
    ...(keptAside.length > 0
      ? [`${input}: values that LAS's own fields cannot hold are in ${keptAside.join(", ")}`]
      : []),
    ...(rounded.length > 0
      ? [`${input}: floating-point ${rounded.join(", ")} rounded to the whole numbers of LAS`]
      : []),
  ];
}

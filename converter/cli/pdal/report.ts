import { count } from "../terminal/output.js";
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
  /** Whether coordinates are the integers that they were; else they are rounded to the nearest step. */
  readonly asStored: boolean;
  /** Attributes that keep what LAS's own fields cannot hold. */
  readonly keptAside: readonly string[];
  /** Dimensions that became whole numbers. */
  readonly rounded: readonly string[];
  readonly tempBytes: number;
}

/** What has to be known of inputs that PDAL read. */
export function pdalReport({ version }: Pdal, { probe, form, bytes }: Planned): PdalReport {
  const { points, readers, streamed, job } = probe;
  const { scale, offset, asStored, rounded } = form;
  const keptAside = form.keptAside.map(asideName);
  return {
    input: job.name,
    points,
    version,
    readers,
    streamed,
    scale,
    offset,
    asStored,
    keptAside,
    rounded,
    tempBytes: bytes,
  };
}

/** A line for people, and one for each thing that has to be known. */
export function pdalInWords(report: PdalReport): string[] {
  const { input, points, version, readers, keptAside, rounded } = report;
  const by = `${count(points)} points by PDAL ${version} (${readers.join(", ")})`;
  const lines = [`${input}: ${by}, coordinates ${coordinatesInWords(report)}`];
  if (keptAside.length > 0) {
    lines.push(`${input}: values that LAS's own fields cannot hold are in ${keptAside.join(", ")}`);
  }
  if (rounded.length > 0) {
    lines.push(`${input}: floating-point ${rounded.join(", ")} rounded to the whole numbers of LAS`);
  }
  return lines;
}

function coordinatesInWords({ scale: [x, , z], asStored }: PdalReport): string {
  const inWords = (factor: number) =>
    x === z ? decimal(factor * x) : `${decimal(factor * x)} horizontal and ${decimal(factor * z)} vertical`;
  if (asStored) return `as they are stored, in steps of ${inWords(1)}`;
  return `in steps of ${inWords(1)}, rounded by at most ${inWords(0.5)}`;
}

/** 5e-7 → `0.0000005` */
function decimal(value: number): string {
  return value.toFixed(12).replace(/\.?0+$/, "");
}

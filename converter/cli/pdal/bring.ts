import { open, stat } from "node:fs/promises";
import { basename, join } from "node:path";
import type { CoreEvent } from "../core/core.js";
import { requireSpace } from "../core/scratch.js";
import type { Pdal } from "./find.js";
import { commonScale, type Form, formOf } from "./form.js";
import type { Job } from "./pipeline.js";
import { type Probe, probe } from "./probe.js";
import { writeLas } from "./write.js";

/** A job with the form that its points are written in. */
export interface Planned {
  readonly probe: Probe;
  readonly form: Form;
  /** Bytes of the temporary file. */
  readonly bytes: number;
}

/** Who hears how far PDAL is, and who stops it. */
export interface Surroundings {
  readonly onEvent: (event: CoreEvent) => void;
  readonly signal?: AbortSignal | undefined;
}

/** Bytes for header and records of a temporary file, apart from the points. */
const HEADER_BYTES = 1 << 20;

/** Milliseconds between two looks at how far PDAL is. */
const LOOK_EVERY = 200;

/**
 * Passes over the points of all jobs.
 *
 * @throws PdalError PDAL_FAILED, PDAL_EMPTY, PDAL_COORDINATES
 */
export async function probeAll(
  pdal: Pdal,
  jobs: readonly Job[],
  { onEvent, signal }: Surroundings,
): Promise<Probe[]> {
  const probes: Probe[] = [];
  for (const [index, job] of jobs.entries()) {
    onEvent({ event: "progress", stage: "inspect", done: index, total: jobs.length });
    const found = await probe(pdal, job, signal);
    if (!found.streamed) {
      const text = `${job.name}: PDAL loads all its points into memory; --memory does not limit PDAL`;
      onEvent({ event: "warning", text });
    }
    probes.push(found);
  }
  onEvent({ event: "progress", stage: "inspect", done: jobs.length, total: jobs.length });
  return probes;
}

/**
 * Settles how the points of all jobs are written.
 *
 * @param geographic whether x and y are degrees
 * @param step of the integers that the user wants
 * @throws PdalError PDAL_SCALE
 */
export function plan(probes: readonly Probe[], geographic: boolean, step?: number): Planned[] {
  const stored = commonScale(probes, geographic, step);
  return probes.map((found) => {
    const form = formOf(found, stored);
    return { probe: found, form, bytes: found.points * form.recordLength + HEADER_BYTES };
  });
}

/**
 * Runs the jobs into LAS 1.4 files, one after the other.
 *
 * @param folder temporary folder, removed by whoever made it
 * @returns the files, in the order of the jobs
 * @throws ScratchError TEMP_SPACE before anything is written; PdalError PDAL_FAILED, PDAL_MISMATCH
 */
export async function write(
  pdal: Pdal,
  planned: readonly Planned[],
  folder: string,
  { onEvent, signal }: Surroundings,
): Promise<string[]> {
  await requireSpace(
    folder,
    planned.reduce((sum, { bytes }) => sum + bytes, 0),
  );
  const total = planned.reduce((sum, one) => sum + one.probe.points, 0);
  const files: string[] = [];
  let before = 0;
  for (const [index, { probe: announced, form }] of planned.entries()) {
    const file = join(folder, `${index}-${basename(announced.job.name)}.las`);
    // Made here, so that its growth can be watched from the beginning.
    await (await open(file, "w")).close();
    const watch = setInterval(async () => {
      const written = await stat(file).catch(() => undefined);
      const points = Math.min(announced.points, Math.floor((written?.size ?? 0) / form.recordLength));
      onEvent({ event: "progress", stage: "pdal", done: before + points, total });
    }, LOOK_EVERY);
    try {
      await writeLas(pdal, announced, form, file, signal);
    } finally {
      clearInterval(watch);
    }
    before += announced.points;
    onEvent({ event: "progress", stage: "pdal", done: before, total });
    files.push(file);
  }
  return files;
}

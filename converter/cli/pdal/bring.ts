import { open, stat } from "node:fs/promises";
import { basename, join } from "node:path";
import type { CoreEvent } from "../core.js";
import { requireSpace } from "../scratch.js";
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

/** What PDAL has to be told of the scale, and who hears how far it is. */
export interface Surroundings {
  /** Step of the integers that the user wants. */
  readonly scale?: number | undefined;
  readonly onEvent: (event: CoreEvent) => void;
  readonly signal?: AbortSignal | undefined;
}

/** Bytes for header and records of a temporary file, apart from the points. */
const HEADER_BYTES = 1 << 20;

/** Milliseconds between two looks at how far PDAL is. */
const LOOK_EVERY = 200;

/**
 * Passes over the points of all jobs once, and settles how they are written.
 *
 * @throws PdalError PDAL_FAILED, PDAL_EMPTY, PDAL_COORDINATES, PDAL_SCALE
 */
export async function plan(
  pdal: Pdal,
  jobs: readonly Job[],
  { scale, onEvent, signal }: Surroundings,
): Promise<Planned[]> {
  const probes: Probe[] = [];
  for (const [index, job] of jobs.entries()) {
    onEvent({ event: "progress", stage: "inspect", done: index, total: jobs.length });
    const found = await probe(pdal, job, signal);
    if (!found.streamed) {
      onEvent({
        event: "warning",
        text: `${job.name}: PDAL holds all its points in memory, --memory does not bind it`,
      });
    }
    probes.push(found);
  }
  onEvent({ event: "progress", stage: "inspect", done: jobs.length, total: jobs.length });
  const stored = commonScale(probes, scale);
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

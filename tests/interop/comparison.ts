import { join } from "node:path";
import { expect } from "vitest";
import { pythonMissing, runPython } from "../python.js";
import { convert, coreMissing, inPairs, type Limits, type Outcome } from "./core.js";

/** Why comparisons with the referees are skipped, in the order of what is missing. */
export const refereesMissing = coreMissing ?? pythonMissing;

/** What `compare.py` finds out about a COPC file; see there. */
export interface Comparison {
  points: number;
  nodes: number;
  levels: number;
  largestNode: number;
  statistics: { rgbBits: number | null; classes: Record<string, number> };
  records: [user: string, recordId: number][];
  /** What stopped the comparison; then nothing else is there. */
  error?: string;
}

/** A conversion and what the referees say of it. */
export interface Converted {
  output: string;
  outcome: Outcome;
  /** Undefined where the conversion failed. */
  found: Comparison | undefined;
}

/** What each input list becomes. */
export interface Job {
  readonly inputs: readonly string[];
  /** Files with the same records that the referees read instead; none for a check of the output alone. */
  readonly references?: readonly string[];
  readonly options?: readonly string[];
}

/**
 * Compares COPC files with their inputs, all of them in one process of Python.
 * @param seconds how long the referees may take for one of them
 */
export function compareAll(
  jobs: readonly (readonly [output: string, inputs: readonly string[]])[],
  seconds = 250,
): Comparison[] {
  if (jobs.length === 0) return [];
  return runPython<Comparison[]>("interop/compare.py", [String(seconds)], JSON.stringify(jobs));
}

/** Converts every job to a COPC file in the folder, and compares all of them in one go. */
export async function convertAndCompare(
  folder: string,
  jobs: readonly Job[],
  limits?: Limits,
): Promise<Converted[]> {
  const output = (index: number) => join(folder, `out-${index}.copc.laz`);
  const numbered = jobs.map((job, index) => ({ ...job, index }));
  const outcomes = await inPairs(numbered, ({ inputs, options = [], index }) =>
    convert([...inputs, output(index), ...options], limits),
  );
  const done = numbered.filter(({ index }) => outcomes[index]!.status === 0);
  const found = compareAll(
    done.map(({ inputs, references, index }) => [output(index), references ?? inputs] as const),
  );
  const byIndex = new Map(done.map(({ index }, place) => [index, found[place]]));
  return outcomes.map((outcome, index) => ({ output: output(index), outcome, found: byIndex.get(index) }));
}

/** Expects that the referees found every record once and every rule kept. */
export function expectFaithful(found: Comparison | undefined, name = ""): Comparison {
  expect(found?.error, name).toBeUndefined();
  expect(found, name).toMatchObject({
    expectedPoints: found?.points,
    broken: [],
    outsideCube: 0,
    sameRecords: true,
    sameScaleAndOffset: true,
    sameBounds: true,
    sameReturns: true,
    sameGpsTimes: true,
    sameGpsTimeType: true,
    sameWkt: true,
    copclib: true,
    laspy: true,
  });
  return found as Comparison;
}

/** Expects a conversion that succeeded and lost nothing. */
export function expectConverted({ outcome, found }: Converted, name = ""): Comparison {
  expect(outcome, name).toMatchObject({ status: 0, signal: null });
  expect(outcome.events.at(-1), name).toMatchObject({ event: "done" });
  return expectFaithful(found, name);
}

/** The name of a test, with the reason where it is skipped. */
export const titled = (name: string, missing: string | undefined): string =>
  missing === undefined ? name : `${name} (skipped: ${missing})`;

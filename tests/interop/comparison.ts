import { join } from "node:path";
import { expect } from "vitest";
import { pythonMissing, runPython } from "../python.js";
import { convert, coreMissing, withFolder } from "./core.js";

/** Why comparisons with the referees are skipped, in the order of what is missing. */
export const refereesMissing = coreMissing ?? pythonMissing;

/** What `compare.py` finds out about a COPC file; see there. */
export interface Comparison {
  points: number;
  nodes: number;
  largestNode: number;
  statistics: { rgbBits: number | null; classes: Record<string, number> };
  records: [user: string, recordId: number][];
}

/** Converts scans into one COPC file and lets laspy, lazrs and copclib say whether all is in it. */
export function expectFaithful(inputs: readonly string[]): Comparison {
  return withFolder((folder) => {
    const output = join(folder, "out.copc.laz");
    const { status, events } = convert([...inputs, output]);
    expect(events.at(-1)).toMatchObject({ event: "done" });
    expect(status).toBe(0);
    const found = runPython<Comparison & Record<string, unknown>>("interop/compare.py", [output, ...inputs]);
    expect(found).toMatchObject({
      hierarchySum: found.points,
      expectedPoints: found.points,
      wrong: { outsideCube: 0, orphans: 0, notContiguous: 0, empty: 0 },
      sameRecords: true,
      sameRecordsByChunkTable: true,
      sameScaleAndOffset: true,
      sameBounds: true,
      sameReturns: true,
      sameGpsTimes: true,
      sameWkt: true,
      copclib: { sameNodes: true, sameLargestNode: true },
    });
    return found;
  });
}

/** The name of a test, with the reason where it is skipped. */
export const titled = (name: string, missing: string | undefined): string =>
  missing === undefined ? name : `${name} (skipped: ${missing})`;

import { rmSync } from "node:fs";
import { afterAll, expect, test } from "vitest";
import { convertAndCompare, expectConverted, refereesMissing, titled } from "../interop/comparison.js";
import { makeFolder } from "../interop/core.js";
import { runPython } from "../python.js";

const folder = makeFolder();
afterAll(() => rmSync(folder, { recursive: true, force: true }));

test.skipIf(refereesMissing)(
  titled("scans that are hard to divide, and headers that lie of bounds, lose no point", refereesMissing),
  { timeout: 120_000 },
  async () => {
    const cases = runPython<{ name: string; inputs: string[]; references: string[] }[]>("faults/shapes.py", [
      folder,
    ]);
    expect(cases.length).toBeGreaterThan(40);
    const results = await convertAndCompare(folder, cases, { memory: 3072 });
    for (const [index, { name }] of cases.entries()) expectConverted(results[index]!, name);
  },
);

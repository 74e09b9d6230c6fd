import { rmSync } from "node:fs";
import { afterAll, expect, test } from "vitest";
import { runPython } from "../python.js";
import { convertAndCompare, expectConverted, refereesMissing, titled } from "./comparison.js";
import { makeFolder } from "./core.js";

const folder = makeFolder();
afterAll(() => rmSync(folder, { recursive: true, force: true }));

test.skipIf(refereesMissing)(
  titled(
    "every field of every point format arrives whole, from LAS and LAZ, one file and many",
    refereesMissing,
  ),
  { timeout: 120_000 },
  async () => {
    const cases = runPython<{ name: string; inputs: string[] }[]>("interop/generate.py", [folder]);
    expect(cases.length).toBeGreaterThan(40);
    const results = await convertAndCompare(folder, cases);
    for (const [index, { name }] of cases.entries()) expectConverted(results[index]!, name);
  },
);

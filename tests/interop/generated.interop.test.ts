import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { runPython } from "../python.js";
import { expectFaithful, refereesMissing, titled } from "./comparison.js";
import { withFolder } from "./core.js";

describe("scans written by laspy", () => {
  test.skipIf(refereesMissing)(
    titled("every point format arrives whole, with its extra bytes", refereesMissing),
    { timeout: 300_000 },
    () => {
      withFolder((folder) => {
        const names = runPython<string[]>("interop/generate.py", [folder]);
        expect(names).toHaveLength(22);
        for (const name of names) {
          expect(expectFaithful([join(folder, name)]).points, name).toBe(4000);
        }
        const both = expectFaithful([join(folder, "format-7.laz"), join(folder, "format-3.las")]);
        expect(both.points).toBe(8000);
      });
    },
  );
});

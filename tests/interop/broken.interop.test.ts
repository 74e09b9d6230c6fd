import { copyFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { data } from "../project.js";
import { pythonMissing, runPython } from "../python.js";
import { titled } from "./comparison.js";
import { convert, coreMissing, filesOf, withFolder } from "./core.js";

/** Files of the data folder that hold no scan, or not all of one. */
const broken: readonly [name: string, code: string][] = [
  ["A_B.e57", "INPUT_MAGIC"],
  ["las__1.2-with-color-clipped.las", "INPUT_TRUNCATED"],
  ["las__garbage_nVariableLength.las", "INPUT_TRUNCATED"],
  ["las__no-points.las", "INPUT_EMPTY"],
];

describe("a broken file gives one error, and no file", () => {
  for (const [name, code] of broken) {
    const { path, missing } = data(`las-variants/${name}`);
    const reason = coreMissing ?? missing;
    test.skipIf(reason)(titled(`${name}: ${code}`, reason), () =>
      withFolder(async (folder) => {
        copyFileSync(path, join(folder, "in"));
        const { status, events } = await convert([join(folder, "in"), join(folder, "out.copc.laz")]);
        expect(status).toBe(1);
        expect(events.filter((line) => line.event === "error")).toHaveLength(1);
        expect(events.at(-1)).toMatchObject({ event: "error", code });
        expect(filesOf(folder)).toEqual(["in"]);
      }),
    );
  }
});

/** Files with faults that cost no point, and what is said of them. */
const mended: readonly [name: string, points: number, extra: string[], warning: RegExp][] = [
  [
    "c13_latin1_extra_names.las",
    1500,
    ["H\u00f6he \u00a8", "Cluster\u00a8ID"],
    /the name of the attribute H\u00f6he .* is not UTF-8; it is read as Latin-1/,
  ],
  [
    "c16a_eb_longer_none.las",
    1500,
    [],
    /the attribute Amplitude is described as the extra bytes 1 to 2, and 0 are there/,
  ],
  [
    "c16b_eb_longer.las",
    1500,
    ["Amplitude", "Reflectance"],
    /the attribute Deviation is described as the extra bytes 5 to 6, and 4 are there/,
  ],
  ["k26_table_short.copc.laz", 6000, [], /the chunk table covers 5920 of 6000 points; all were recovered/],
];

describe("a fault that costs no point is told, and the output is one that others read", () => {
  for (const [name, points, extra, warning] of mended) {
    const { path, missing } = data(`reports/${name}`);
    const reason = coreMissing ?? missing ?? pythonMissing;
    test.skipIf(reason)(titled(name, reason), () =>
      withFolder(async (folder) => {
        const output = join(folder, "out.copc.laz");
        const { status, events } = await convert([path, output]);
        expect(status).toBe(0);
        expect(events.at(-1)).toMatchObject({ event: "done", points });
        const warnings = events.filter((line) => line.event === "warning").map(({ text }) => text);
        expect(warnings.join("\n")).toMatch(warning);
        expect(runPython("interop/laspy_read.py", [output])).toEqual({ points, extra });
      }),
    );
  }

  const short = data("reports/k26_table_short.copc.laz");
  const reason = coreMissing ?? short.missing;
  test.skipIf(reason)(titled("unless a short chunk table is to be refused", reason), () =>
    withFolder(async (folder) => {
      const { events } = await convert([short.path, join(folder, "out.copc.laz"), "--strict"]);
      expect(events.at(-1)).toMatchObject({ event: "error", code: "INPUT_CORRUPT" });
    }),
  );
});

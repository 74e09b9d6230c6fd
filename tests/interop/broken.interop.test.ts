import { copyFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { data } from "../project.js";
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

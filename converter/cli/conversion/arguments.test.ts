import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, expect, it } from "vitest";
import type { Georeferenced } from "../place/georeference.js";
import { coreArguments } from "./arguments.js";

const scratch = mkdtempSync(join(tmpdir(), "groma-arguments-"));
afterAll(() => rmSync(scratch, { recursive: true }));

const unit = { name: "metre", kind: "linear", size: 1 } as const;
const LOCAL = {
  crs: {
    ...{ name: 'a "b" é', proj4: "", horizontalUnit: unit, height: { kind: "unknown" } },
    verticalUnit: { ...unit, declared: false },
  },
  ...{ basis: "anchor", notes: [], local: {} },
} as unknown as Georeferenced;
const wkt = ["--wkt", join(scratch, "crs.wkt")];

it("passes on what was said, and what the output declares", async () => {
  expect(await coreArguments(["a.las"], "o.laz", LOCAL, {}, scratch)).toEqual([
    ...wkt,
    "--",
    "a.las",
    "o.laz",
  ]);
  expect(readFileSync(wkt[1]!, "utf8")).toMatch(/^LOCAL_CS\["a 'b' ",/);
  const options = {
    sampling: "poisson",
    averageColors: true,
    threads: 3,
    memory: "1GB",
    tempDir: "t",
  } as const;
  expect(
    await coreArguments(
      ["-a.las", "b.las"],
      "o.laz",
      LOCAL,
      { ...options, overwrite: true, strict: true },
      scratch,
    ),
  ).toEqual([
    ...[...wkt, "--sampling", "poisson", "--threads", "3", "--memory", "1GB", "--temp-dir", "t"],
    ...["--average-colors", "--strict", "--overwrite", "--", "-a.las", "b.las", "o.laz"],
  ]);
});

it("puts more inputs than a command line may hold into a list", async () => {
  const inputs = Array.from({ length: 10_000 }, (_, index) => `tile ${index}.laz`);
  const args = await coreArguments(inputs, "o.laz", LOCAL, {}, scratch);
  expect(args).toEqual([...wkt, "--list", join(scratch, "inputs.txt"), "--", "o.laz"]);
  expect(readFileSync(args[3]!, "utf8").trimEnd().split("\n")).toEqual(inputs);
});

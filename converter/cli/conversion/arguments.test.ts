import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, expect, it } from "vitest";
import { coreArguments } from "./arguments.js";

const scratch = mkdtempSync(join(tmpdir(), "groma-arguments-"));
afterAll(() => rmSync(scratch, { recursive: true }));

it("passes on what was said, and nothing else", async () => {
  expect(await coreArguments(["a.las"], "o.laz", {}, scratch)).toEqual(["--", "a.las", "o.laz"]);
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
      { ...options, overwrite: true, strict: true },
      scratch,
      "w",
    ),
  ).toEqual([
    ...["--wkt", "w", "--sampling", "poisson", "--threads", "3", "--memory", "1GB", "--temp-dir", "t"],
    ...["--average-colors", "--strict", "--overwrite", "--", "-a.las", "b.las", "o.laz"],
  ]);
});

it("puts more inputs than a command line may hold into a list", async () => {
  const inputs = Array.from({ length: 10_000 }, (_, index) => `tile ${index}.laz`);
  const args = await coreArguments(inputs, "o.laz", {}, scratch);
  expect(args).toEqual(["--list", join(scratch, "inputs.txt"), "--", "o.laz"]);
  expect(readFileSync(args[1]!, "utf8").trimEnd().split("\n")).toEqual(inputs);
});

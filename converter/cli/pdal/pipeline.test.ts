import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, expect, it } from "vitest";
import { pipelineJob } from "./pipeline.js";

const folder = mkdtempSync(join(tmpdir(), "groma-pipeline-"));
afterAll(() => rmSync(folder, { recursive: true }));

function file(content: unknown): string {
  const path = join(folder, "p.json");
  writeFileSync(path, typeof content === "string" ? content : JSON.stringify(content));
  return path;
}

it("takes an array or an object, and puts the inputs in front", async () => {
  const stages = [{ type: "filters.range", limits: "Z[0:]" }];
  const expected = [{ filename: "a.e57" }, ...stages];
  expect((await pipelineJob(file(stages), ["a.e57"])).stages).toEqual(expected);
  expect((await pipelineJob(file({ pipeline: stages }), ["a.e57"])).stages).toEqual(expected);
  expect((await pipelineJob(file(["b.ply"]), [])).stages).toEqual(["b.ply"]);
});

it.each<[string, unknown, RegExp]>([
  ["no JSON", "[", /not valid JSON/],
  ["no pipeline", { stages: [] }, /not a PDAL pipeline/],
  ["numbers", [1], /not a PDAL pipeline/],
  ["a writer", ["a.las", { type: "writers.las" }], /contains the writer writers\.las\. Remove the writer/],
  ["nothing to read", [{ type: "filters.range" }], /has no reader/],
  ["nothing at all", [], /has no reader/],
])("refuses %s by name", async (_, content, message) => {
  const refused = pipelineJob(file(content), []);
  await expect(refused).rejects.toMatchObject({
    code: "PDAL_PIPELINE",
    message: expect.stringMatching(message),
  });
});

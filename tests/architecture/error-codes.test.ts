import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";
import { projectRoot } from "../project.js";

it("docs/layer.md lists every code of a StyleError, and no other", () => {
  const room = join(projectRoot, "layer/src");
  const codes = readdirSync(room, { recursive: true, encoding: "utf8" })
    .filter((name) => /(?<!\.test|\.fixture)\.ts$/.test(name))
    .flatMap((name) => readFileSync(join(room, name), "utf8").match(/(?<=")STYLE_[A-Z_]+(?=")/g) ?? []);
  const rows = readFileSync(join(projectRoot, "docs/layer.md"), "utf8").match(/^\| `STYLE_.*$/gm) ?? [];
  const listed = rows.flatMap((row) => row.split(" | ")[0].match(/STYLE_[A-Z_]+/g) ?? []);
  expect(listed.length).toBeGreaterThan(15);
  expect(listed.toSorted()).toEqual([...new Set(codes)].sort());
});

import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { cruise, type IConfiguration, type ICruiseResult } from "dependency-cruiser";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

const rules = createRequire(import.meta.url)("../../.ci/arrows.cjs") as IConfiguration;

/** Violations of the arrows, as `rule: from -> to`, in the tree at `root`. */
async function violations(root: string): Promise<string[]> {
  const places = ["georef", "layer", "converter", "demo"];
  const { output } = await cruise(places, {
    ...rules.options,
    ruleSet: rules,
    validate: true,
    baseDir: root,
  });
  const result = output as ICruiseResult;
  expect(result.summary.totalCruised).toBeGreaterThan(0);
  return result.summary.violations.map(({ rule, from, to }) => `${rule.name}: ${from} -> ${to}`);
}

describe("the import arrows of the house", () => {
  it("hold in the whole tree", { timeout: 60_000 }, async () => {
    expect(await violations(projectRoot)).toEqual([]);
  });

  it("are seen when broken (negative control)", async () => {
    const root = mkdtempSync(join(projectRoot, "tests/artifacts/arrows-"));
    const file = (path: string, text: string) => {
      mkdirSync(join(root, path, ".."), { recursive: true });
      writeFileSync(join(root, path), text);
    };
    try {
      file("tsconfig.base.json", "{}");
      file("georef/src/a.ts", 'import { b } from "../../layer/src/octree/b.js"; export const a = b;');
      file("layer/src/octree/b.ts", 'import { c } from "../cesium/c.js"; export const b = c;');
      file("layer/src/cesium/c.ts", "export const c = 1;");
      file("converter/cli/d.ts", 'import { c } from "../../layer/src/cesium/c.js"; export const d = c;');
      file("demo/src/e.ts", "export const e = 1;");
      const names = (await violations(root)).map((line) => line.split(":")[0]);
      expect(new Set(names)).toEqual(
        new Set(["georef-stands-alone", "layer-octree", "cli-knows-view-independent-rooms"]),
      );
    } finally {
      rmSync(root, { recursive: true });
    }
  });
});

import { spawnSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

const read = (name: string) => readFileSync(join(projectRoot, name), "utf8");

/** Numbers with their units in the README's promises, `0.007 mm` or `1,500`, links left out. */
function promised(readme: string): string[] {
  const part = /^## What it promises\n([\s\S]*?)^Not yet/m.exec(readme)![1]!.replace(/\]\([^)]*\)/g, "]");
  // Names like LV95 and "3D" are no numbers of their own.
  const numbers = part.match(/(?<![\w.])\d[\d,.]*(?:\s(?:mm|km|kB|MB|ms|s|%|m)\b)?(?!\w)/g) ?? [];
  return [...new Set(numbers.map((number) => number.replace(/\s/, " ").replace(/[.,]$/, "")))];
}

describe("what the README promises", () => {
  const claims = read("docs/claims.md");

  it("has a test and a referee for every number", () => {
    const numbers = promised(read("README.md"));
    expect(numbers).toContain("0.007 mm");
    const rows = claims.split("\n").filter((row) => /^\| `/.test(row));
    const held = rows.flatMap((row) => row.split(" | ")[0]!.match(/(?<=`)[^`,]+(?:,\d+)?(?=`)/g) ?? []);
    expect(numbers.filter((number) => !held.includes(number))).toEqual([]);
    for (const row of rows) expect(row).toMatch(/\| \[.*\]\(\.\.\/.*\.test\.ts\).* \| \S.* \|$/);
  });

  it("names tests that are there", () => {
    const files = [...claims.matchAll(/\]\(\.\.\/([^)]+\.test\.ts)\)/g)].map(([, file]) => file!);
    expect(files.length).toBeGreaterThan(8);
    expect(files.filter((file) => !existsSync(join(projectRoot, file)))).toEqual([]);
  });

  it("is read with its numbers (negative control)", () => {
    const readme =
      "## What it promises\n\nwithin 3 mm, 1,600 points of LV95, [a 7](x/8.md), in\n9 km.\nNot yet\n";
    expect(promised(readme)).toEqual(["3 mm", "1,600", "7", "9 km"]);
  });
});

it("the manual and its reference are made without a warning: no link leads nowhere", {
  timeout: 120_000,
}, () => {
  const script = join(projectRoot, "docs/typedoc.mjs");
  const { status, stdout, stderr } = spawnSync(process.execPath, [script, "--check"], { encoding: "utf8" });
  expect([status, status === 0 ? "" : stdout + stderr]).toEqual([0, ""]);
});

describe("the errors of the manual", () => {
  it("name every family of codes", () => {
    const listed = [...read("docs/manual/errors.md").matchAll(/`([A-Z]+_?)`/g)].map(([, family]) => family!);
    const codes = ["converter/cli", "layer/src", "georef/src", "demo/src"].flatMap((room) =>
      readdirSync(join(projectRoot, room), { recursive: true, encoding: "utf8" })
        .filter((name) => /(?<!\.test|\.fixture)\.ts$/.test(name))
        .flatMap((name) => read(join(room, name)).match(/(?<=code: ")[A-Z]+(?:_[A-Z_]+)?(?=")/g) ?? []),
    );
    expect(codes.length).toBeGreaterThan(100);
    const families = [...new Set(codes.map((code) => code.replace(/_.*/, "_")))];
    expect(families.filter((family) => !listed.includes(family))).toEqual([]);
  });
});

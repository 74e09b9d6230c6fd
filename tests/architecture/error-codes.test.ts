import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
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

/** Where errors come from. */
const ROOMS = [
  "georef/src",
  "layer/src",
  "converter/cli",
  "converter/bin",
  "converter/src",
  "demo/src",
  "demo/public",
];

/** What begins like a code and is none: variables of PROJ's surroundings, a number of LAS. */
const NO_CODES = ["PROJ_DATA", "PROJ_DEBUG", "PROJ_LIB", "PROJ_NETWORK", "RECORD_ID"];

/** Text of all sources but tests, the core's unit tests left out. */
function sources(): string[] {
  return ROOMS.flatMap((room) =>
    readdirSync(join(projectRoot, room), { recursive: true, encoding: "utf8" })
      .filter((name) => /(?<!\.test|\.fixture)\.(ts|mjs|js|rs)$/.test(name))
      .map((name) =>
        readFileSync(join(projectRoot, room, name), "utf8").replace(/#\[cfg\(test\)\][\s\S]*$/, ""),
      ),
  );
}

/** Words that are codes of these families, in code or in what is said of it; constants of that name are none. */
function codesOf(texts: readonly string[], families: readonly string[]): Set<string> {
  const code = new RegExp(`(?<![\\w.$])(?:${families.join("|")})_[A-Z][A-Z0-9_]*\\b`, "g");
  const constants = texts.flatMap(
    (text) => text.match(/(?<=\b(?:const|let|static) )[A-Z][A-Z0-9_]+\b/g) ?? [],
  );
  const named = texts.flatMap((text) => [...(text.match(code) ?? []), ...optionsOfCore(text)]);
  const none = new Set([...constants, ...NO_CODES]);
  return new Set(named.filter((name) => !none.has(name)));
}

/** Codes that the core makes of an option's name. */
const optionsOfCore = (text: string) =>
  [...text.matchAll(/Error::option\(\s*"([A-Z_]+)"/g)].map(([, name]) => `OPTION_${name}`);

describe("docs/manual/error-codes.md", () => {
  const read = (page: string) => readFileSync(join(projectRoot, "docs/manual", page), "utf8");
  const rows = read("error-codes.md")
    .split("\n")
    .filter((row) => row.startsWith("| `"));
  const listed = rows.flatMap((row) => row.split(" | ")[0]!.match(/(?<=`)[A-Z0-9_]+(?=`)/g) ?? []);

  const families = [...read("errors.md").matchAll(/`([A-Z]+)_`/g)].map(([, family]) => family!);

  it("has codes of every family that errors.md names", () => {
    expect(families.filter((family) => !listed.some((code) => code.startsWith(`${family}_`)))).toEqual([]);
  });

  it("lists every code that the sources have, once, and no other", () => {
    // Those that are put together of two parts.
    const composed = ["EMPTY", "NOT_FOUND", "SYNTAX"].map((end) => `CONTROL_${end}`);
    const codes = new Set([...codesOf(sources(), families), ...composed, "INTERNAL", "INTERRUPTED"]);
    expect(codes.size).toBeGreaterThan(200);
    expect(listed.toSorted()).toEqual([...codes].sort());
  });

  it("has a way out for each", () => {
    for (const row of rows) expect(row).toMatch(/^\| `.*` \| \S.* \| \S.* \|$/);
  });

  it("is held against what the sources say (negative control)", () => {
    const texts = ['throw refuse("PAGE_NEW");', "const PAGE_LIMIT = 3;", 'Error::option(\n"WAY", cause)'];
    expect([...codesOf(texts, ["PAGE"])]).toEqual(["PAGE_NEW", "OPTION_WAY"]);
  });
});

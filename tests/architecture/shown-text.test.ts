import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";

/**
 * Where text that people read leaves the project. Names and contents of files are made safe to show there and nowhere
 * else, so nothing may pass by: on the terminal `print` and its like, on the page `setText` and its like.
 */
const EXITS = [
  {
    room: "converter/cli",
    writing: /process\.std(out|err)\.write|\bconsole\.|\bstdout\.write/,
    files: ["terminal/output.ts", "terminal/progress.ts"],
  },
  {
    room: "demo/src",
    writing:
      /\.(textContent|innerText|innerHTML|outerHTML) = |insertAdjacent|new Option\(|document\.write|createTextNode|parseFromString|\bconsole\./,
    files: ["panel/elements.ts"],
  },
];

describe("text for people", () => {
  it.each(EXITS)("leaves $room by $files only", ({ room, writing, files }) => {
    const sources = readdirSync(join(projectRoot, room), { recursive: true, encoding: "utf8" }).filter(
      (name) => name.endsWith(".ts") && !name.endsWith(".test.ts"),
    );
    expect(sources.length).toBeGreaterThan(20);
    const writers = sources.filter((name) =>
      writing.test(readFileSync(join(projectRoot, room, name), "utf8")),
    );
    expect(writers.map((name) => name.replaceAll("\\", "/")).sort()).toEqual([...files].sort());
  });
});

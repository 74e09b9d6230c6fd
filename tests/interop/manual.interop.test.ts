import { spawnSync } from "node:child_process";
import { chmodSync, existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { delimiter, join } from "node:path";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { lasOf } from "../faults/las-bytes.js";
import { projectRoot } from "../project.js";
import { coreMissing, makeFolder } from "./core.js";

const skipped = process.platform === "win32" ? "the examples are for a POSIX shell" : coreMissing;
const folder = makeFolder();
const manual = join(projectRoot, "docs/manual");

/** A scan of a box of 1 km with its corner there, in whatever system the reader names. */
function scan(name: string, corner: readonly [number, number, number]): void {
  const bytes = lasOf(2_000);
  const view = new DataView(bytes.buffer);
  for (const [axis, offset] of corner.entries()) {
    view.setFloat64(155 + 8 * axis, offset, true);
    view.setFloat64(179 + 16 * axis, offset + (axis === 2 ? 50 : 1000), true);
    view.setFloat64(187 + 16 * axis, offset, true);
  }
  writeFileSync(join(folder, name), bytes);
}

/** The examples of a page for the shell. */
const examples = (page: string): string[] =>
  [...readFileSync(join(manual, page), "utf8").matchAll(/^```sh\n([\s\S]*?)^```$/gm)].map(
    ([, code]) => code!,
  );

/** Pages in the order that the manual reads in; later ones use the files of earlier ones. */
const pages = ["globe.md", ...readdirSync(manual).filter((name) => name !== "globe.md")].filter(
  (name) => name.endsWith(".md") && examples(name).length > 0,
);

beforeAll(() => {
  // What a reader brings along.
  scan("scan.las", [2_600_000, 1_200_000, 500]);
  scan("east.las", [2_601_000, 1_200_000, 500]);
  scan("feet.las", [636_000, 849_000, 400]);
  scan("statue.las", [0, 0, 0]);
  const groma = join(folder, "groma");
  writeFileSync(
    groma,
    `#!/bin/sh\nexec "${process.execPath}" "${join(projectRoot, "converter/bin/groma.mjs")}" "$@"\n`,
  );
  chmodSync(groma, 0o755);
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe.skipIf(skipped)(`the examples of the manual${skipped ? ` (skipped: ${skipped})` : ""}`, () => {
  it("are there", () => expect(pages.length).toBeGreaterThan(5));

  it.each(pages)("of %s run as they stand", { timeout: 120_000 }, (page) => {
    const env = { ...process.env, PATH: [folder, process.env.PATH].join(delimiter) };
    for (const code of examples(page)) {
      const { status, stderr } = spawnSync("sh", ["-e", "-c", code], { cwd: folder, env, encoding: "utf8" });
      expect([code, status, status === 0 ? "" : stderr]).toEqual([code, 0, ""]);
      for (const [, output] of code.matchAll(/--out (\S+)|convert .*?(\S+\.copc\.laz)/g)) {
        if (output) expect(existsSync(join(folder, output))).toBe(true);
      }
    }
  });
});

import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type * as georef from "@groma/georef";
import { build } from "vite";
import { describe, expect, it } from "vitest";
import type * as errors from "../../layer/src/errors/index.js";
import { projectRoot } from "../project.js";

type Bundle = typeof georef & typeof errors;

/** The libraries as an application's build makes them: one file, the names of classes shortened. */
async function minified(folder: string): Promise<Bundle> {
  const entry = join(folder, "entry.js");
  const errorsFile = join(projectRoot, "layer/dist/errors/index.js");
  writeFileSync(entry, `export * from "@groma/georef"; export * from ${JSON.stringify(errorsFile)};`);
  const outDir = join(folder, "dist");
  const lib = { entry, formats: ["es"] as ["es"], fileName: "bundle" };
  await build({ root: folder, logLevel: "error", build: { lib, outDir, minify: true } });
  return (await import(/* @vite-ignore */ pathToFileURL(join(outDir, "bundle.js")).href)) as Bundle;
}

describe("a minified build", { timeout: 120_000 }, () => {
  it("keeps the names of errors and revives those of a worker; it names its engine", async () => {
    mkdirSync(join(projectRoot, "tests/artifacts"), { recursive: true });
    const folder = mkdtempSync(join(projectRoot, "tests/artifacts/minified-"));
    try {
      const page = await minified(folder);
      expect(page.CrsError.name).not.toBe("CrsError");
      const fault = { code: "SOURCE_HTTP", file: "a.copc.laz", cause: "it failed", fix: "Look" };
      const fallback = { code: "DECODE_FAILED", file: "node", fix: "Look" };
      for (const name of [
        "SourceError",
        "DecodeError",
        "CrsError",
        "PlacementError",
        "RecordError",
      ] as const) {
        const error = new page[name](fault);
        expect(error.name).toBe(name);
        const revived = page.fromWire(structuredClone(page.toWire(error, fallback)));
        expect(revived).toBeInstanceOf(page[name]);
        expect(revived.name).toBe(name);
      }
      // A worker is another bundle, with short names of its own: what it sends has the full ones.
      const wire = { kind: "PlacementError", ...fault };
      expect(page.fromWire(wire)).toBeInstanceOf(page.PlacementError);
      expect(page.ENGINE).toEqual({ name: "proj4js", version: expect.stringMatching(/^2\.\d+/) });
    } finally {
      rmSync(folder, { recursive: true });
    }
  });

  it("finds every class of errors with a name that stays", () => {
    const classes = ["georef/src", "layer/src", "converter/cli", "demo/src"].flatMap((room) =>
      readdirSync(join(projectRoot, room), { recursive: true, encoding: "utf8" })
        .filter((name) => name.endsWith(".ts") && !name.endsWith(".test.ts"))
        .flatMap((name) => [
          ...readFileSync(join(projectRoot, room, name), "utf8").matchAll(
            /class (\w+) extends (?:Groma)Error \{\n(?: {2}static override readonly kind = "(\w+)";)?/g,
          ),
        ]),
    );
    expect(classes.length).toBeGreaterThan(15);
    for (const [, name, kind] of classes) expect(kind).toBe(name);
  });
});

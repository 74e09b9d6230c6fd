import { readFileSync } from "node:fs";
import { join } from "node:path";
import { rolldown } from "rolldown";
import { describe, expect, it } from "vitest";
import { projectRoot } from "../project.js";
import { firstChunks, zippedBytes } from "./first-chunks.js";

const dist = join(projectRoot, "layer/dist");
const releases = readFileSync(join(projectRoot, "docs/releases.md"), "utf8");
/** What an application pays for an entry, by the table of that page: own code, and all but Cesium and OpenLayers, kB. */
const table = [...releases.matchAll(/^\| `(@groma\/layer[/a-z]*)` +\| +(\d+) kB +\| +(\d+) kB +\|$/gm)].map(
  ([, name, own, all]) => [name!, Number(own), Number(all)] as const,
);

/** What is neither a path nor a package of the project. */
const OTHERS = /^(?![./\\]|@groma)(?![A-Z]:)/;

/** Kilobytes of an entry and of all that is loaded with it at once, minified and zipped, without what is named. */
async function size(entry: string, external: RegExp): Promise<number> {
  const bundle = await rolldown({ input: entry, platform: "browser", external: (id) => external.test(id) });
  const { output } = await bundle.generate({ format: "es", minify: true });
  await bundle.close();
  return zippedBytes(firstChunks(output).map(({ code }) => code)) / 1000;
}

describe("what an entry weighs", () => {
  it("is told of every entry that has code", () => {
    const { exports } = JSON.parse(readFileSync(join(projectRoot, "layer/package.json"), "utf8"));
    const entries = Object.keys(exports).filter((name) => !/\.(js(on)?|wasm)$/.test(name));
    expect(table.map(([name]) => name).sort()).toEqual(
      entries.map((name) => `@groma/layer${name.slice(1)}`).sort(),
    );
  });

  it.each(table)(
    "%s: %d kB of its own, %d kB with what it needs",
    { timeout: 60_000 },
    async (name, own, all) => {
      const entry = join(dist, name.slice("@groma/layer".length), "index.js");
      const ours = await size(entry, OTHERS);
      expect(ours).toBeLessThan(150);
      for (const [stated, measured] of [
        [own, ours],
        [all, await size(entry, /^(cesium|ol)($|\/)/)],
      ] as const) {
        // A table that is a quarter off is old.
        expect(measured).toBeLessThan(1.25 * stated);
        expect(measured).toBeGreaterThan(0.75 * stated);
      }
    },
  );

  it.each(["node.worker.js", "node.projections.js", "groma-laz.wasm"])("%s, a file of its own", (name) => {
    const stated = Number(new RegExp(`\\(\`${name}\`, (\\d+) kB\\)`).exec(releases)![1]);
    expect(zippedBytes([readFileSync(join(dist, "workers", name))]) / 1000).toBeCloseTo(stated, -1);
  });
});

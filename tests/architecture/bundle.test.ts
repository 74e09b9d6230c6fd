import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { expect, it } from "vitest";
import { projectRoot } from "../project.js";
import { firstChunks, zippedBytes } from "./first-chunks.js";

/** What a page of a few lines is built into, without the libraries that are named. */
async function built(name: string, code: string, external: (string | RegExp)[]) {
  const folder = join(projectRoot, "tests/artifacts/bundle");
  mkdirSync(folder, { recursive: true });
  const entry = join(folder, `${name}.js`);
  writeFileSync(entry, code);
  const { build } = await import("vite");
  const made = await build({
    root: folder,
    logLevel: "error",
    configFile: false,
    build: { write: false, target: "es2022", rollupOptions: { input: entry, external } },
  });
  const { output } = Array.isArray(made) ? made[0]! : (made as Exclude<typeof made, { on: unknown }>);
  const assets = output.flatMap((part) => (part.type === "asset" ? [part] : []));
  return { first: firstChunks(output), assets };
}

/** Bytes, gzipped, of a page's script that imports a module of the library; libraries of views and proj4 left out. */
async function sizeOf(name: string): Promise<number> {
  const code = `import * as all from "@groma/${name}";\nglobalThis.all = all;\n`;
  const { first } = await built(name.replaceAll("/", "-"), code, [/^ol\//, "proj4", "cesium"]);
  return zippedBytes(first.map((chunk) => chunk.code));
}

it("a layer of OpenLayers is at most 60 kB of own code beyond the cloud and ol", {
  timeout: 120_000,
}, async () => {
  const [cloud, map] = [await sizeOf("layer"), await sizeOf("layer/openlayers")];
  expect(map - cloud).toBeGreaterThan(5_000);
  expect(map - cloud).toBeLessThan(60_000);
});

it.each([
  ["cesium", "PointCloudLayer"],
  ["openlayers", "PointCloudLayer, PointCloudSource"],
])(
  "until a page with %s shows its first points it loads no projections, and no more than it did",
  {
    timeout: 120_000,
  },
  async (entry, names) => {
    const code = `import { ${names} } from "@groma/layer/${entry}";\nglobalThis.used = [${names}];\n`;
    const { first, assets } = await built(`first-picture-${entry}`, code, ["cesium", /^ol\//]);
    const modules = first.flatMap((chunk) => Object.keys(chunk.modules));
    expect(modules.length).toBeGreaterThan(100);
    const late = /proj4|mgrs|wkt-parser|georef\/dist\/crs\/(wkt|datum|epsg)/;
    expect(modules.filter((path) => late.test(path))).toEqual([]);
    const [worker, decoder] = [/node\.worker/, /groma-laz/].map(
      (name) => assets.find(({ fileName }) => name.test(fileName))!.source,
    );
    expect(String(worker)).not.toMatch(/longlat|tmerc/);
    expect(zippedBytes(first.map((chunk) => chunk.code))).toBeLessThan(115_000);
    expect(zippedBytes([worker!])).toBeLessThan(28_000);
    expect(zippedBytes([decoder!])).toBeLessThan(56_000);
  },
);

/**
 * Bundles the entries of the layer for pages without a bundler, into dist/standalone: all that it needs but Cesium and
 * OpenLayers, which an import map names. The entries share their code, so that globe and map draw one PointCloud.
 */
import { readFileSync, rmSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { rolldown } from "rolldown";

const dist = join(import.meta.dirname, "..", "dist");
const out = join(dist, "standalone");

/** Files beside a module are still found when it lies in dist/standalone. */
const filesBeside = {
  name: "groma-files-beside",
  transform(code, id) {
    if (!id.startsWith(dist) || !code.includes("import.meta.url")) return null;
    const folder = relative(out, dirname(id)).replaceAll("\\", "/");
    return code.replaceAll('new URL("./', `new URL("${folder}/`);
  },
};

rmSync(out, { recursive: true, force: true });
const { exports } = JSON.parse(readFileSync(join(dist, "../package.json"), "utf8"));
const entries = Object.values(exports).flatMap(({ types, default: file }) => (types ? [file] : []));
const bundle = await rolldown({
  // ./dist/cesium/index.js is cesium.js, ./dist/index.js is index.js.
  input: Object.fromEntries(
    entries.map((file) => [
      file
        .split("/")
        .at(-2)
        .replace(/^dist$/, "index"),
      join(dist, "..", file),
    ]),
  ),
  external: /^(cesium|ol)($|\/)/,
  platform: "browser",
  plugins: [filesBeside],
  // What one entry shares with another must not bring the rest of that one along.
  experimental: { chunkOptimization: { mergeCommonChunks: false } },
});
await bundle.write({
  dir: out,
  format: "es",
  minify: true,
  entryFileNames: "[name].js",
  chunkFileNames: "shared-[name].js",
});
await bundle.close();

/**
 * Completes layer/dist after tsc: the workers as one file each without bare imports, so that any bundler and
 * any server can load them, the decoder's WebAssembly beside them, the schema of measurements, the tables of EPSG, and the
 * entries for pages without a bundler.
 */
import { copyFileSync } from "node:fs";
import { join } from "node:path";
import { rolldown } from "rolldown";

const workers = join(import.meta.dirname, "..", "dist", "workers");
const wasm = "../../converter/wasm/target/wasm32-unknown-unknown/release/groma_laz.wasm";

copyFileSync(join(import.meta.dirname, wasm), join(workers, "groma-laz.wasm"));
const schema = "measurements.schema.json";
copyFileSync(join(import.meta.dirname, "../../docs", schema), join(workers, "..", schema));

const laz = join(workers, "..", "export", "compressor");
const volume = join(workers, "..", "tools", "measure", "volume");
for (const [folder, name, entry = "entry.js"] of [
  [workers, "node.worker.js"],
  [workers, "node.projections.js", "projections.js"],
  [volume, "volume.worker.js"],
  [laz, "laz.worker.js"],
]) {
  const bundle = await rolldown({ input: join(folder, entry), platform: "browser" });
  await bundle.write({
    file: join(folder, name),
    format: "es",
    minify: true,
    sourcemap: true,
    codeSplitting: false,
  });
  await bundle.close();
}

await import("./crs-assets.mjs");
await import("./standalone.mjs");

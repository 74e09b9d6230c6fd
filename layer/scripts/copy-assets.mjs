/**
 * Completes layer/dist after tsc: the worker as one file without bare imports, so that any bundler and any
 * server can load it, the decoder's WebAssembly beside it, the schema of measurements, and the tables of EPSG.
 */
import { copyFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { rolldown } from "rolldown";

const workers = join(import.meta.dirname, "..", "dist", "workers");
const wasm = createRequire(import.meta.url).resolve("laz-perf/lib/worker/laz-perf.wasm");

copyFileSync(wasm, join(workers, "laz-perf.wasm"));
const schema = "measurements.schema.json";
copyFileSync(join(import.meta.dirname, "../../docs", schema), join(workers, "..", schema));

const bundle = await rolldown({ input: join(workers, "entry.js"), platform: "browser" });
await bundle.write({
  file: join(workers, "node.worker.js"),
  format: "es",
  sourcemap: true,
  codeSplitting: false,
});
await bundle.close();

await import("./crs-assets.mjs");

import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { expect, it } from "vitest";
import { projectRoot } from "../project.js";

/** Bytes, gzipped, of a page's script that imports a module of the library; libraries of views and proj4 left out. */
async function sizeOf(name: string): Promise<number> {
  const folder = join(projectRoot, "tests/artifacts/bundle");
  mkdirSync(folder, { recursive: true });
  const entry = join(folder, `${name.replaceAll("/", "-")}.js`);
  writeFileSync(entry, `import * as all from "@groma/${name}";\nglobalThis.all = all;\n`);
  const { build } = await import("vite");
  const built = await build({
    root: folder,
    logLevel: "error",
    configFile: false,
    worker: { format: "es" },
    build: {
      write: false,
      target: "es2022",
      rollupOptions: { input: entry, external: [/^ol\//, "proj4", "cesium"] },
    },
  });
  const { output } = Array.isArray(built) ? built[0]! : (built as Exclude<typeof built, { on: unknown }>);
  // What is fetched only when needed is not among what a page begins with.
  const first = output.filter((part) => part.type === "chunk" && part.isEntry);
  return first.reduce((sum, part) => sum + gzipSync("code" in part ? part.code : "").length, 0);
}

it("a layer of OpenLayers is at most 60 kB of own code beyond the cloud and ol", {
  timeout: 120_000,
}, async () => {
  const [cloud, map] = [await sizeOf("layer"), await sizeOf("layer/openlayers")];
  expect(map - cloud).toBeGreaterThan(5_000);
  expect(map - cloud).toBeLessThan(60_000);
});

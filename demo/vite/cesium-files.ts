import { cp } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import send from "send";
import type { Plugin } from "vite";

/** What Cesium fetches at run time; its code itself is bundled like any other. */
const FOLDERS = ["Assets", "ThirdParty", "Widgets", "Workers"] as const;

/** Where the page finds them, relative to itself. */
const PLACE = "cesium";

/**
 * Serves the files that Cesium fetches at run time from the package that is installed, and copies them beside the
 * built page, so that nothing comes from another host. Sets `CESIUM_BASE_URL`, by which Cesium finds them.
 */
export function cesiumFiles(): Plugin {
  const build = join(
    dirname(createRequire(import.meta.url).resolve("cesium/package.json")),
    "Build",
    "Cesium",
  );
  let target = "";
  return {
    name: "groma-cesium-files",
    config: () => ({ define: { CESIUM_BASE_URL: JSON.stringify(`./${PLACE}/`) } }),
    configResolved({ root, build: { outDir } }) {
      target = join(root, outDir, PLACE);
    },
    configureServer({ middlewares }) {
      for (const folder of FOLDERS) {
        middlewares.use(`/${PLACE}/${folder}`, (request, response) => {
          const { pathname } = new URL(request.url ?? "/", "http://localhost");
          send(request, pathname, { root: join(build, folder) }).pipe(response);
        });
      }
    },
    async writeBundle() {
      for (const folder of FOLDERS) await cp(join(build, folder), join(target, folder), { recursive: true });
    },
  };
}

import { join } from "node:path";
import { lingui } from "@lingui/vite-plugin";
import { defineConfig } from "vite";
import { cesiumFiles } from "./vite/cesium-files.js";
import { knockoutWithoutEval } from "./vite/knockout.js";
import { thirdPartyNotices } from "./vite/notices.js";
import { completeWords } from "./vite/words.js";

export default defineConfig({
  root: import.meta.dirname,
  // Relative, so that the built page works under any path of any static server.
  base: "./",
  plugins: [
    lingui({
      configPath: join(import.meta.dirname, "lingui.config.ts"),
      failOnMissing: true,
      failOnCompileError: true,
    }),
    completeWords(),
    cesiumFiles(),
    knockoutWithoutEval(),
    thirdPartyNotices(),
  ],
  resolve: { dedupe: ["cesium", "ol", "proj4"] },
  worker: { format: "es" },
  build: {
    outDir: "dist",
    target: "es2022",
    // Cesium is most of the bundle and comes as one piece.
    chunkSizeWarningLimit: 6000,
  },
});

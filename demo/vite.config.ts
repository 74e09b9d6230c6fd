import { defineConfig } from "vite";
import { cesiumFiles } from "./vite/cesium-files.js";
import { thirdPartyNotices } from "./vite/notices.js";

export default defineConfig({
  root: import.meta.dirname,
  // Relative, so that the built page works under any path of any static server.
  base: "./",
  plugins: [cesiumFiles(), thirdPartyNotices()],
  resolve: { dedupe: ["cesium", "ol", "proj4"] },
  worker: { format: "es" },
  build: {
    outDir: "dist",
    target: "es2022",
    // Cesium is most of the bundle and comes as one piece.
    chunkSizeWarningLimit: 6000,
  },
});

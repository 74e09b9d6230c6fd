import vue from "@vitejs/plugin-vue";
import { defineConfig } from "vite";

// One build for the three of them; each needs no more of it than its own line.
export default defineConfig({
  root: import.meta.dirname,
  plugins: [vue()],
  worker: { format: "es" },
  build: {
    target: "es2022",
    chunkSizeWarningLimit: 6000,
    rolldownOptions: {
      input: ["vite", "react", "vue"].map((name) => `${import.meta.dirname}/${name}/index.html`),
    },
  },
});

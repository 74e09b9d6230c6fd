import { defineConfig } from "vitest/config";

/** Rooms of the suite by what they need; `tests/run.mjs` runs them all. */
const rooms = {
  unit: [
    "georef/src/**/*.test.ts",
    "layer/src/**/*.test.ts",
    "converter/cli/**/*.test.ts",
    "demo/**/*.test.ts",
  ],
  architecture: ["tests/architecture/**/*.test.ts"],
  numerics: ["tests/numerics/**/*.test.ts"],
  faults: ["tests/faults/**/*.test.ts"],
  interop: ["tests/interop/**/*.test.ts"],
  browser: ["tests/browser/**/*.test.ts"],
};

export default defineConfig({
  test: {
    testTimeout: 30_000,
    hookTimeout: 120_000,
    setupFiles: ["tests/properties.ts"],
    projects: Object.entries(rooms).map(([name, include]) => ({
      extends: true,
      // A browser test fills both cores by itself.
      test: { name, include, fileParallelism: name !== "browser" && name !== "interop" },
    })),
  },
});

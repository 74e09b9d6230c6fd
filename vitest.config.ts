import { readFileSync } from "node:fs";
import { availableParallelism } from "node:os";
import { join } from "node:path";
import { lingui } from "@lingui/vite-plugin";
import { defineConfig } from "vitest/config";

/** Packages that tests read as sources, so that an edit reaches every test without a build. */
const LIBRARIES = ["georef", "layer"];

/** Each module that a library exports, by the name that it is imported by, and the source it is built from. */
const sources = LIBRARIES.flatMap((folder) => {
  const { name, exports } = JSON.parse(
    readFileSync(join(import.meta.dirname, folder, "package.json"), "utf8"),
  );
  return Object.entries<string | { default: string }>(exports).map(([path, target]) => {
    const built = typeof target === "string" ? target : target.default;
    const source = built.replace(/^\.\/dist\//, "src/").replace(/\.js$/, ".ts");
    const find = `${name}${path.slice(1)}`.replace(/[./]/g, "\\$&");
    return { find: new RegExp(`^${find}$`), replacement: join(import.meta.dirname, folder, source) };
  });
});

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
  install: ["tests/install/**/*.test.ts"],
  browser: ["tests/browser/**/*.test.ts"],
};

export default defineConfig({
  plugins: [lingui({ configPath: join(import.meta.dirname, "demo/lingui.config.ts") })],
  resolve: { alias: sources },
  test: {
    testTimeout: 30_000,
    hookTimeout: 120_000,
    // One fewer without this: half of a machine with two cores.
    maxWorkers: availableParallelism(),
    setupFiles: ["tests/properties.ts"],
    // What a page is to show comes within a second on a quiet machine, and not on a busy one.
    expect: { poll: { timeout: 60_000 } },
    projects: Object.entries(rooms).map(([name, include]) => ({
      extends: true,
      test: {
        name,
        include,
        // Two pages at a time: one waits for its picture while the other draws. Each process has a Chromium of its own.
        ...(name === "browser" ? { maxWorkers: 2 } : {}),
        fileParallelism: name !== "install",
        // Projects with fewer files at a time go by themselves, after the others.
        sequence: { groupOrder: ["browser", "install"].indexOf(name) + 1 },
        // Loading the modules anew for each of many short files takes as long as the tests themselves.
        isolate: name === "install",
      },
    })),
  },
});

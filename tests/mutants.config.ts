import { join } from "node:path";
import { defineConfig } from "vitest/config";
import base from "../vitest.config.js";

const places = (process.env.GROMA_MUTANTS_TESTS ?? "").split(",");

/** The tests that a mutation run holds its mutants against, without the projects of the suite. */
export default defineConfig({
  root: join(import.meta.dirname, ".."),
  ...(base.resolve && { resolve: base.resolve }),
  test: {
    include: places.map((place) => `${place}/**/*.test.ts`),
    setupFiles: ["tests/properties.ts"],
    testTimeout: 60_000,
  },
});

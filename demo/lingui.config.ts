import { readFileSync } from "node:fs";
import { extractor } from "@lingui/cli/api";
import { defineConfig, type ExtractorType } from "@lingui/conf";
import { parseHTML } from "linkedom";
import { LANGUAGES } from "./src/language/languages.js";
import { textsOf } from "./src/language/markup.js";

/** The words of `index.html`: they stand there in English, and are looked up when the page starts. */
const markup: ExtractorType = {
  match: (file) => file.endsWith(".html"),
  extract(file, code, found) {
    const { document } = parseHTML(code || readFileSync(file, "utf8"));
    for (const { words } of textsOf(document.body)) found({ id: words, origin: [file, 0] });
  },
};

export default defineConfig({
  sourceLocale: "en",
  locales: LANGUAGES.map(({ code }) => code),
  catalogs: [
    {
      path: "<rootDir>/src/language/catalogues/{locale}",
      include: ["<rootDir>/src", "<rootDir>/index.html"],
      exclude: ["**/*.test.ts", "**/*.d.ts"],
    },
  ],
  extractors: [markup, extractor],
  orderBy: "messageId",
  // Neither files nor lines: code that moves changes no catalogue.
  formatOptions: { origins: false },
});

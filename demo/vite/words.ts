import { join } from "node:path";
import { getCatalogs } from "@lingui/cli/api";
import { getConfig } from "@lingui/conf";
import type { Plugin } from "vite";

/** What is wrong with the words of a language; nothing where every list is empty. */
export interface WordFaults {
  /** Without a translation, or not in the catalogue at all. */
  readonly missing: readonly string[];
  /** In the catalogue, and nowhere on the page. */
  readonly unused: readonly string[];
  /** Whose translation fills in other values than the English words do. */
  readonly unlike: readonly string[];
}

/** Holds the catalogues against the words of the page, by language. */
export async function wordFaults(): Promise<Map<string, WordFaults>> {
  const root = join(import.meta.dirname, "..");
  const config = getConfig({ cwd: root, configPath: join(root, "lingui.config.ts") });
  const [catalogue] = await getCatalogs(config);
  const collected = await catalogue!.collect();
  // Of a file that cannot be read, the tool has told on the terminal.
  if (!collected) throw new Error("the words of the page cannot be collected");
  const used = Object.keys(collected);
  const faults = new Map<string, WordFaults>();
  for (const locale of config.locales) {
    const words = new Map(Object.entries((await catalogue!.read(locale)) ?? {}));
    const translated = (id: string) => words.get(id)?.translation || (locale === "en" ? id : "");
    faults.set(locale, {
      missing: used.filter((id) => !translated(id) || !words.has(id) || words.get(id)?.obsolete),
      unused: [...words.keys()].filter((id) => !(id in collected) || words.get(id)?.obsolete),
      unlike: used.filter((id) => translated(id) && valuesIn(id) !== valuesIn(translated(id))),
    });
  }
  return faults;
}

/** Names of the values that a message of ICU's takes, sorted. */
function valuesIn(message: string): string {
  return [...new Set(Array.from(message.matchAll(/\{(\w+)[,}]/g), ([, name]) => name))].sort().join(" ");
}

/** Fails the build where a word of the page is missing in a language. */
export function completeWords(): Plugin {
  return {
    name: "groma-complete-words",
    apply: "build",
    async buildStart() {
      for (const [locale, faults] of await wordFaults()) {
        for (const [kind, ids] of Object.entries(faults)) {
          if (ids.length > 0)
            this.error(`${locale}.po: ${kind}: ${ids.map((id: string) => `"${id}"`).join(", ")}`);
        }
      }
    },
  };
}

/// <reference path="./catalogue.d.ts" />
import { i18n, type Messages } from "@lingui/core";
import { LANGUAGES, type Language, languageFor } from "./languages.js";
import { textsOf } from "./markup.js";

/** Of the page's storage. */
const KEY = "groma-language";

/** Catalogues that are fetched when they are wanted; English is there. */
const CATALOGUES: ReadonlyMap<string, () => Promise<{ readonly messages: Messages }>> = new Map([
  ["de", () => import("./catalogues/de.po")],
  ["es", () => import("./catalogues/es.po")],
  ["fr", () => import("./catalogues/fr.po")],
  ["ja", () => import("./catalogues/ja.po")],
]);

/**
 * Puts the page into the reader's language: the one that was chosen here, else the browser's. To be called before
 * anything else writes on the page. English stays where a catalogue does not come.
 */
export async function beginLanguage(): Promise<void> {
  const chosen = storedLanguage();
  await show(languageFor([...(chosen ? [chosen] : []), ...navigator.languages]));
}

async function show({ code, direction }: Language): Promise<void> {
  const load = CATALOGUES.get(code);
  if (!load) return;
  try {
    const { messages } = await load();
    i18n.loadAndActivate({ locale: code, messages });
  } catch {
    return;
  }
  document.documentElement.lang = code;
  document.documentElement.dir = direction;
  for (const text of textsOf(document.body)) text.write(i18n.t(text.words));
}

/** Keeps a language for this visit and the next. @returns false where the browser keeps nothing */
export function keepLanguage(code: string): boolean {
  try {
    localStorage.setItem(KEY, code);
    return true;
  } catch {
    return false;
  }
}

function storedLanguage(): string | undefined {
  try {
    const code = localStorage.getItem(KEY);
    return LANGUAGES.find((one) => one.code === code)?.code;
  } catch {
    return undefined;
  }
}

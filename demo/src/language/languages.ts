/** A language of the page. */
export interface Language {
  /** BCP 47 tag, as in `lang`. */
  readonly code: string;
  /** What its readers call it. */
  readonly name: string;
  readonly direction: "ltr" | "rtl";
}

/** All there are; English first, which every text falls back to. */
export const LANGUAGES: readonly [Language, ...Language[]] = [
  { code: "en", name: "English", direction: "ltr" },
  { code: "de", name: "Deutsch", direction: "ltr" },
  { code: "es", name: "Español", direction: "ltr" },
  { code: "fr", name: "Français", direction: "ltr" },
  { code: "ja", name: "日本語", direction: "ltr" },
];

/**
 * The first language wanted that there is: `de-CH` is served by `de`.
 * @param wanted BCP 47 tags in the reader's order
 */
export function languageFor(wanted: readonly string[]): Language {
  for (const tag of wanted) {
    const [primary] = tag.toLowerCase().split("-");
    const found = LANGUAGES.find(({ code }) => code === primary);
    if (found) return found;
  }
  return LANGUAGES[0];
}

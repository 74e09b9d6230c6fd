import { i18n } from "./i18n.js";
import { knows, libraryWords } from "./library-words.js";
import { SCAN_PATTERNS } from "./scan-words.js";

/** A remark of a library, and whether it is in the reader's language. */
export interface Note {
  readonly text: string;
  readonly translated: boolean;
}

/** Remarks that have names or numbers in them. */
const PATTERNS: readonly (readonly [RegExp, (...found: string[]) => string])[] = [
  [/^(.*): drawn without its geoid$/, (model) => i18n.t("{model}: drawn without its geoid", { model })],
  [/^(.*): not in use at this place$/, (model) => i18n.t("{model}: not in use at this place", { model })],
  [
    /^(.*): nodes rounded to a centimetre$/,
    (model) => i18n.t("{model}: nodes rounded to a centimetre", { model }),
  ],
  [
    /^(.*): by (.*) in place of its own geoid$/,
    (model, geoid) => i18n.t("{model}: by {geoid} in place of its own geoid", { model, geoid }),
  ],
  [
    /^(.*): its accuracy is part of the datum operation's$/,
    (model) => i18n.t("{model}: its accuracy is part of the datum operation's", { model }),
  ],
  [
    /^(.*); a difference of datums is passed over$/,
    (operation) => i18n.t("{operation}; a difference of datums is passed over", { operation }),
  ],
  [
    /^declared as shifted by (\S+) \(Vertical_Shift\), which is not applied$/,
    (shift) =>
      i18n.t("declared as shifted by {shift} (Vertical_Shift), which is not applied", {
        shift: i18n.number(Number(shift)),
      }),
  ],
  [
    /^declared as depths below an ellipsoid, which other software takes for heights$/,
    () => i18n.t("declared as depths below an ellipsoid, which other software takes for heights"),
  ],
  [
    /^declared above the ellipsoid of (.*), and taken as above that of (.*), as PROJ does$/,
    (other, own) =>
      i18n.t("declared above the ellipsoid of {other}, and taken as above that of {own}, as PROJ does", {
        other,
        own,
      }),
  ],
  [
    /^greatest of (\d+) residuals, their RMS is (\S+) m$/,
    (count, rms) =>
      i18n.t("greatest of {count} residuals, their RMS is {rms} m", { count, rms: i18n.number(Number(rms)) }),
  ],
  [
    /^shown as ellipsoidal; if the heights are above sea level(?:, such as (.*))?, the points should be (\S+) m (lower|higher)$/,
    seaLevel,
  ],
];

function seaLevel(system: string | undefined, metres: string, way: string): string {
  const values = { metres: i18n.number(Number(metres)) };
  const shown = i18n.t("shown as ellipsoidal");
  const such = system === undefined ? "" : ` (${i18n.t("such as {system}", { system })})`;
  const moved =
    way === "lower"
      ? i18n.t("if the heights are above sea level, the points should be {metres} m lower", values)
      : i18n.t("if the heights are above sea level, the points should be {metres} m higher", values);
  return `${shown}; ${moved}${such}`;
}

/** A remark of a library in the reader's language; one that the page does not know stays English. */
export function noteWords(english: string): Note {
  if (i18n.locale === "en") return { text: english, translated: true };
  if (knows(english)) return { text: libraryWords(english), translated: true };
  for (const [pattern, words] of [...PATTERNS, ...SCAN_PATTERNS]) {
    const found = pattern.exec(english);
    if (found) return { text: words(...found.slice(1)), translated: true };
  }
  return { text: english, translated: false };
}

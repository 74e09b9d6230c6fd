/** Most characters of a string that a message repeats. */
const LONGEST = 40;

/** Characters that a terminal or a page would act on, or show as nothing. */
const UNSEEN = /[\u007f-\u009f\u00ad\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]/g;

/** A value that a caller gave, as a message may show it: short, and without characters that act. */
export function shown(value: unknown): string {
  if (typeof value === "string") {
    const short = value.length > LONGEST ? `${value.slice(0, LONGEST)}…` : value;
    return JSON.stringify(short).replace(
      UNSEEN,
      (character) => `\\u${character.charCodeAt(0).toString(16).padStart(4, "0")}`,
    );
  }
  if (typeof value === "function") return "a function";
  if (Array.isArray(value)) return value.length === 0 ? "an empty array" : `an array of ${value.length}`;
  return typeof value === "object" && value !== null ? "an object" : String(value);
}

/** Words as a list to choose from: `a, b or c`. */
export function listed(words: readonly string[]): string {
  return words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} or ${words.at(-1)}`;
}

/** What to use in place of a word that is none of those valid: the closest one first, then all. */
export function instead(word: unknown, valid: readonly string[]): string {
  const near = typeof word === "string" ? closest(word, valid) : undefined;
  const all = `use ${listed(valid)}`;
  return near === undefined ? all : `did you mean "${near}"? Otherwise ${all}`;
}

/** The valid word that a misspelt one most likely stands for: at most a third of its letters are wrong. */
export function closest(word: string, valid: readonly string[]): string | undefined {
  if (word.length > LONGEST) return undefined;
  const allowed = Math.max(1, Math.floor(word.length / 3));
  let best: string | undefined;
  let least = allowed + 1;
  for (const candidate of valid) {
    const distance = editDistance(word.toLowerCase(), candidate.toLowerCase());
    if (distance < least) [best, least] = [candidate, distance];
  }
  return best;
}

/**
 * Letters to be inserted, left out, replaced or swapped with their neighbour to make one word of another: optimal string
 * alignment (F. Damerau, Communications of the ACM 7 (1964) 171–176).
 */
function editDistance(a: string, b: string): number {
  const rows = [Array.from({ length: b.length + 1 }, (_, column) => column)];
  for (let i = 1; i <= a.length; i++) {
    const row = [i];
    for (let j = 1; j <= b.length; j++) {
      const same = a[i - 1] === b[j - 1];
      row[j] = Math.min(rows[i - 1][j] + 1, row[j - 1] + 1, rows[i - 1][j - 1] + (same ? 0 : 1));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) {
        row[j] = Math.min(row[j], rows[i - 2][j - 2] + 1);
      }
    }
    rows.push(row);
  }
  return rows[a.length][b.length];
}

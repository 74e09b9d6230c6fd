/**
 * What a reader does not see or what steers a terminal: control characters (C0, C1, escapes), format characters
 * (direction marks, zero-width characters, tags), line and paragraph separators, half surrogate pairs, and letters
 * without a picture (Unicode Standard Annex 44, properties General_Category and Default_Ignorable_Code_Point).
 */
const UNSEEN = /[\p{Cc}\p{Cf}\p{Cs}\p{Zl}\p{Zp}\p{Default_Ignorable_Code_Point}]/gu;

/** UTF-16 code units of a text that are shown: a longer one loses its middle, since both of its ends may name things. */
const MOST = 1000;
const HEAD = 700;
const TAIL = 250;

/**
 * A text from elsewhere (a file, a file's name, a server, another program) as one line that is safe to show: unseen
 * characters become `\u{…}`, and a text of more than 1000 characters loses its middle. For people only: a program that
 * reads the result would not get the text back.
 */
export function printable(text: string): string {
  return shortened(text).replace(UNSEEN, (character) => `\\u{${character.codePointAt(0)!.toString(16)}}`);
}

function shortened(text: string): string {
  if (text.length <= MOST) return text;
  const head = text.slice(0, HEAD).replace(/[\uD800-\uDBFF]$/, "");
  const tail = text.slice(-TAIL).replace(/^[\uDC00-\uDFFF]/, "");
  const left = text.length - head.length - tail.length;
  return `${head} … (${left.toLocaleString("en-US")} more characters) … ${tail}`;
}

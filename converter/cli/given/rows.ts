import { readFile } from "node:fs/promises";
import { text } from "node:stream/consumers";
import { GromaError } from "@groma/georef";

/** A file of numbers cannot be read. Codes: POINTS_* for points, CONTROL_* for control points. */
class RowsError extends GromaError {
  static override readonly kind = "RowsError";
}

/** One line of numbers. */
export interface Row {
  /** Counted from 1. */
  readonly line: number;
  readonly values: readonly number[];
}

/** What the lines of a file have to be. */
export interface RowFormat {
  /** First part of the codes. */
  readonly kind: "POINTS" | "CONTROL";
  /** In words, for who got it wrong. */
  readonly columns: string;
  readonly fewest: number;
  readonly most: number;
}

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;
const EXCERPT = 40;

/**
 * Reads lines of numbers, separated by spaces, commas or semicolons; what follows a `#` is a remark.
 *
 * @param file path, `-` for standard input
 * @throws RowsError POINTS_NOT_FOUND, POINTS_SYNTAX with the number of the line, POINTS_EMPTY; CONTROL_* likewise
 */
export async function readRows(file: string, format: RowFormat): Promise<Row[]> {
  const rows = parseRows(await content(file, format), file, format);
  if (rows.length > 0) return rows;
  throw refusal(format, "EMPTY", file, "there is no line of numbers in it");
}

/** The rows of a text, see {@link readRows}. */
export function parseRows(content: string, file: string, format: RowFormat): Row[] {
  const rows: Row[] = [];
  for (const [index, whole] of content
    .replace(/^\uFEFF/, "")
    .split(/\r\n|\n|\r/)
    .entries()) {
    const body = whole.replace(/#.*/, "").trim();
    if (body === "") continue;
    const words = body.split(/\s*[,;]\s*|\s+/);
    const wrong = (cause: string) => refusal(format, "SYNTAX", file, `line ${index + 1}: ${cause}`);
    const odd = words.find((word) => !(NUMBER.test(word) && Number.isFinite(Number(word))));
    if (odd !== undefined) throw wrong(`"${odd.slice(0, EXCERPT)}" is no number`);
    if (words.length < format.fewest || words.length > format.most) {
      const { fewest, most } = format;
      const expected = fewest === most ? String(most) : `${fewest} or ${most}`;
      const hint = words.length > most ? "; use a decimal point" : "";
      throw wrong(`expected ${expected} numbers, found ${words.length}${hint}`);
    }
    rows.push({ line: index + 1, values: words.map(Number) });
  }
  return rows;
}

async function content(file: string, format: RowFormat): Promise<string> {
  if (file === "-") return text(process.stdin);
  try {
    return await readFile(file, "utf8");
  } catch (error) {
    const reason = error instanceof Error && "code" in error ? ` (${error.code})` : "";
    throw refusal(format, "NOT_FOUND", file, `it cannot be read${reason}`);
  }
}

function refusal({ kind, columns }: RowFormat, code: string, file: string, cause: string): RowsError {
  return new RowsError({ code: `${kind}_${code}`, file, cause, fix: `give one "${columns}" per line` });
}

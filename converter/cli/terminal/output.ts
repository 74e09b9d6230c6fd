import type { Fault } from "@groma/georef";
import { printable } from "@groma/georef/printable";

// The one place where the commands write to the terminal: whatever a line holds of files, their names and other
// programs is made safe here, so that no caller has to think of it.

/** Prints lines for people on standard output. A line break within a line is shown, not made. */
export function print(lines: readonly string[]): void {
  process.stdout.write(shown(lines));
}

/** Prints lines for people on standard error. */
export function complain(lines: readonly string[]): void {
  process.stderr.write(shown(lines));
}

function shown(lines: readonly string[]): string {
  return lines.map((line) => `${printable(line)}\n`).join("");
}

/** Characters that JSON leaves as they are although they steer a terminal. */
const UNSEEN_IN_JSON = /[\x7f-\x9f\p{Cf}\p{Zl}\p{Zp}]/gu;

/**
 * Prints a value for programs on standard output: JSON that reads back exactly, in ASCII where a terminal would not show
 * the character.
 *
 * @param indent spaces per level; on one line without
 */
export function printJson(value: unknown, indent?: number): void {
  const escaped = (text: string) =>
    text.replace(/./gs, (unit) => `\\u${unit.charCodeAt(0).toString(16).padStart(4, "0")}`);
  process.stdout.write(`${JSON.stringify(value, undefined, indent).replace(UNSEEN_IN_JSON, escaped)}\n`);
}

/** Lines of a table of two columns. @param width of the first column, characters */
export function labelled(rows: readonly (readonly [label: string, text: string])[], width = 8): string[] {
  return rows.map(([label, text]) => `${label.padEnd(width)} ${text}`);
}

/**
 * Ends the command quietly once whoever reads its output has gone, as `head` does after its last line, and with
 * OUTPUT_WRITE once it cannot be written otherwise: the disk is full, say. Work that has to tidy up is stopped as by a
 * signal.
 */
export function endWithReader(): void {
  let ended = false;
  for (const stream of [process.stdout, process.stderr]) {
    stream.on("error", ({ code, message }: NodeJS.ErrnoException) => {
      if (ended) return;
      ended = true;
      if (code !== "EPIPE") {
        process.exitCode = 1;
        const cause = `it cannot be written (${message})`;
        complain([`OUTPUT_WRITE: output of groma: ${cause}. Free space, or send it elsewhere.`]);
      }
      if (process.listenerCount("SIGTERM") > 0) process.emit("SIGTERM");
      else process.exit();
    });
  }
}

/** What every error of Groma has; told by its members, so that nothing has to be loaded to tell it. */
interface Told {
  readonly code: string;
  readonly fix: string;
  readonly message: string;
}

function isTold(error: unknown): error is Told {
  return error instanceof Error && "code" in error && "fix" in error;
}

/** Prints an error as `CODE: file: cause. fix.` on standard error; the exit code becomes 1. */
export function fail(error: unknown): void {
  process.exitCode = 1;
  if (isTold(error)) {
    complain([error.message]);
    return;
  }
  const message = error instanceof Error ? `${error.name}: ${error.message}` : String(error);
  const frames = error instanceof Error ? (error.stack?.match(/^ {4}at .*$/gm) ?? []) : [];
  complain([`INTERNAL: groma: ${message}. Report this with the command that you ran.`, ...frames]);
}

/** 10653336 → `10,653,336`. */
export function count(value: number): string {
  return value.toLocaleString("en-US");
}

/** `1 node`, `778 nodes`. */
export function counted(value: number, noun: string): string {
  return `${count(value)} ${noun}${value === 1 ? "" : "s"}`;
}

/** A number rounded to so many digits: `14,300`, `0.135`. */
export function rounded(value: number, digits: number): string {
  return Number(value.toPrecision(digits)).toLocaleString("en-US", { maximumSignificantDigits: digits });
}

/** A number with so many digits behind the point, and never `-0.00`. */
export function fixed(value: number, digits: number): string {
  return (Number(value.toFixed(digits)) + 0).toFixed(digits);
}

const upwards = new Intl.NumberFormat("en-US", {
  maximumSignificantDigits: 2,
  roundingMode: "ceil",
  useGrouping: false,
} as Intl.NumberFormatOptions);

/** An accuracy in metres as people say it, rounded up: what is stated is never less than what is known. */
export function atMost(metres: number): string {
  // Units are exact powers of ten; what their product is off by is no accuracy.
  return inUnit(metres, (value) => upwards.format(Number(value.toPrecision(12))));
}

/** Metres as people say them: `0.02 mm`, `4.3 cm`, `1.25 m`, `23.4 km`. */
export function length(metres: number): string {
  return inUnit(metres, (value) => String(Number(value.toPrecision(3))));
}

function inUnit(metres: number, inWords: (value: number) => string): string {
  const size = Math.abs(metres);
  if (size === 0) return "0 m";
  const [factor, unit] =
    size < 0.01 ? [1000, "mm"] : size < 1 ? [100, "cm"] : size < 1000 ? [1, "m"] : [0.001, "km"];
  return `${inWords(metres * factor)} ${unit}`;
}

/** Bytes as people say them, powers of ten. */
export function size(bytes: number): string {
  const units = ["B", "kB", "MB", "GB", "TB"];
  const power = Math.min(units.length - 1, Math.max(0, Math.floor(Math.log10(bytes) / 3)));
  return `${Number((bytes / 1000 ** power).toPrecision(3))} ${units[power]}`;
}

/** The line of an input that a conversion does without. */
export function skippedRow({ file, code, cause }: Fault): [label: string, text: string] {
  return ["skipped", `${file}: ${cause} (${code})`];
}

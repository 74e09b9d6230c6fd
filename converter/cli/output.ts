import type { Fault } from "@groma/georef";

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
    process.stderr.write(`${error.message}\n`);
    return;
  }
  const text = error instanceof Error ? (error.stack ?? error.message) : String(error);
  process.stderr.write(`INTERNAL: groma: ${text}. Report this with the command that you ran.\n`);
}

/** 10653336 → `10,653,336`. */
export function count(value: number): string {
  return value.toLocaleString("en-US");
}

/** `1 node`, `778 nodes`. */
export function counted(value: number, noun: string): string {
  return `${count(value)} ${noun}${value === 1 ? "" : "s"}`;
}

/** Metres as people say them: `0.02 mm`, `4.3 cm`, `1.25 m`, `23.4 km`. */
export function length(metres: number): string {
  const size = Math.abs(metres);
  if (size === 0) return "0 m";
  const [factor, unit] =
    size < 0.01 ? [1000, "mm"] : size < 1 ? [100, "cm"] : size < 1000 ? [1, "m"] : [0.001, "km"];
  return `${Number((metres * factor).toPrecision(3))} ${unit}`;
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

import { type Command, InvalidArgumentError } from "commander";

/** Values of options as they are typed; each throws InvalidArgumentError for what is none. */

export function positive(text: string): number {
  const number = Number(text);
  if (Number.isFinite(number) && number > 0) return number;
  throw new InvalidArgumentError("Expected a number greater than 0");
}

/** A number. @throws InvalidArgumentError, as all of these do, for what is none */
export function finite(text: string): number {
  const number = text.trim() === "" ? Number.NaN : Number(text);
  if (Number.isFinite(number)) return number;
  throw new InvalidArgumentError("Expected a number");
}

/** A box: least x, y (and z), then greatest, separated by commas. */
export function boxNumbers(text: string): number[] {
  const numbers = text.split(",").map((word) => (word.trim() === "" ? Number.NaN : Number(word)));
  if ((numbers.length === 4 || numbers.length === 6) && numbers.every(Number.isFinite)) return numbers;
  throw new InvalidArgumentError("Expected four or six numbers separated by commas");
}

/** Class numbers from 0 to 255, separated by commas. */
export function classNumbers(text: string): number[] {
  const numbers = text.split(",").map((word) => (/^\s*\d+\s*$/.test(word) ? Number(word) : Number.NaN));
  if (numbers.every((number) => number <= 255)) return numbers;
  throw new InvalidArgumentError("Expected whole numbers from 0 to 255 separated by commas");
}

/** A number from 0 on. */
export function notNegative(text: string): number {
  const number = finite(text);
  if (number >= 0) return number;
  throw new InvalidArgumentError("Expected a number from 0 on");
}

/** Numbers separated by commas. */
export function numbers(text: string): number[] {
  return text.split(",").map(finite);
}

/** Two numbers separated by a comma, in whatever order. */
export function valueRange(text: string): [number, number] {
  const [first, second, ...more] = numbers(text);
  if (first !== undefined && second !== undefined && more.length === 0) return [first, second];
  throw new InvalidArgumentError("Expected two numbers separated by a comma");
}

/** Kinds of returns of a pulse. */
const RETURNS = ["first", "last", "intermediate", "single"] as const;

/** Kinds of returns, separated by commas. */
export function returnKinds(text: string): (typeof RETURNS)[number][] {
  return text.split(",").map((word) => {
    const found = RETURNS.find((kind) => kind === word.trim().toLowerCase());
    if (found) return found;
    throw new InvalidArgumentError(`Expected ${RETURNS.join(", ")}, separated by commas`);
  });
}

type AttributeRange = readonly [name: string, least: number, greatest: number];

/** An attribute and its least and greatest value; those of options before go before it. */
export function attributeRanges(text: string, before: readonly AttributeRange[] = []): AttributeRange[] {
  const at = text.lastIndexOf("=");
  const limits = at > 0 ? numbers(text.slice(at + 1)) : [];
  const name = text.slice(0, at);
  if (limits.length !== 2 || limits[0]! > limits[1]!)
    throw new InvalidArgumentError("Expected NAME=least,greatest, such as intensity=0,500");
  if (before.some(([known]) => known === name)) throw new InvalidArgumentError(`${name} has a range already`);
  return [...before, [name, limits[0]!, limits[1]!]];
}

/** Files that are made of each cross-section. */
const SECTION_FORMATS = ["las", "laz", "csv", "geojson", "dxf", "svg", "pdf"] as const;

/** Formats of the files of a section, separated by commas. */
export function sectionFormats(text: string): (typeof SECTION_FORMATS)[number][] {
  return text.split(",").map((word) => {
    const found = SECTION_FORMATS.find((format) => format === word.trim().toLowerCase());
    if (found) return found;
    throw new InvalidArgumentError(`Expected some of ${SECTION_FORMATS.join(", ")}, separated by commas`);
  });
}

/** `min`, `max`, `mean`, or a percentile such as `p25`. */
export function statistic(text: string): "min" | "max" | "mean" | number {
  if (text === "min" || text === "max" || text === "mean") return text;
  const percentile = /^p(\d+(?:\.\d+)?)$/.exec(text)?.[1];
  if (percentile !== undefined && Number(percentile) <= 100) return Number(percentile);
  throw new InvalidArgumentError("Expected min, max, mean, or a percentile from p0 to p100");
}

/** A number of threads from 1 to 1024. */
export function threadCount(text: string): number {
  const number = Number(text);
  if (Number.isInteger(number) && number >= 1 && number <= 1024) return number;
  throw new InvalidArgumentError("Expected a whole number from 1 to 1024");
}

/** A port from 0 to 65535. */
export function portNumber(text: string): number {
  const number = Number(text);
  if (Number.isInteger(number) && number >= 0 && number <= 65535) return number;
  throw new InvalidArgumentError("Expected a whole number from 0 to 65535");
}

/** Origins as browsers send them. */
export function originList(text: string): string[] {
  return text.split(",").map((piece) => {
    const origin = URL.canParse(piece) ? new URL(piece).origin : "null";
    if (origin !== "null" && piece.replace(/\/$/, "").toLowerCase() === origin) return origin;
    throw new InvalidArgumentError(
      `${piece} is not an origin such as https://maps.example; to let all read, put --cors at the end of the line`,
    );
  });
}

/**
 * Has a command refuse options and arguments that are given without a value, as those of a script are whose variable is
 * not set (`--crs "$CRS"`): taken for not given, they would mean something else than was meant.
 */
export function refuseEmpty(command: Command): void {
  const refuse = (what: string) => command.error(`error: ${what} is empty; give a value, or leave it out`);
  for (const option of command.options) {
    command.on(`option:${option.name()}`, (value: unknown) => {
      if (value === "") refuse(`option '${option.flags}'`);
    });
  }
  command.hook("preAction", () => {
    const at = command.args.indexOf("");
    if (at >= 0) refuse(`argument ${at + 1}`);
  });
}

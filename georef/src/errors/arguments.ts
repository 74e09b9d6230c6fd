import { ArgumentError } from "./errors.js";

/** What an argument, or a field of one, has to be. A question mark: it may be left out. */
export type Kind = "number" | "text" | "bytes" | "list" | "numbers" | "object" | "function";
type Field = Kind | `${Kind}?`;

const WORDS: Readonly<Record<Kind, string>> = {
  number: "a finite number",
  text: "a text",
  bytes: "a Uint8Array",
  list: "an array",
  numbers: "an array of numbers",
  object: "an object",
  function: "a function",
};

/**
 * Refuses an argument that is not of the kind that is declared: callers without TypeScript are told at once, by the names that
 * they know, and not by what happens to fail inside.
 *
 * @param name function and argument, for the message: `resolveCrs: sources`
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function requireKind(value: unknown, kind: Kind, name: string): void {
  if (!isOf(value, kind)) throw invalid(name, WORDS[kind], value);
}

/**
 * The same for an object with fields.
 *
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function requireFields(value: unknown, fields: Readonly<Record<string, Field>>, name: string): void {
  requireKind(value, "object", name);
  for (const [field, wanted] of Object.entries(fields)) {
    const kind = wanted.replace("?", "") as Kind;
    const given = (value as Record<string, unknown>)[field];
    if (given === undefined && kind !== wanted) continue;
    requireKind(given, kind, `${name}.${field}`);
  }
}

function isOf(value: unknown, kind: Kind): boolean {
  switch (kind) {
    case "number":
      return Number.isFinite(value);
    case "text":
      return typeof value === "string";
    case "bytes":
      return value instanceof Uint8Array;
    case "list":
      return Array.isArray(value);
    case "numbers":
      return isList(value) && typeof (value[0] ?? 0) === "number";
    case "object":
      return typeof value === "object" && value !== null;
    case "function":
      return typeof value === "function";
  }
}

function isList(value: unknown): value is ArrayLike<unknown> {
  return Array.isArray(value) || (ArrayBuffer.isView(value) && "length" in value);
}

function invalid(name: string, wanted: string, value: unknown): ArgumentError {
  const given =
    value === null || typeof value !== "object"
      ? String(value)
      : Array.isArray(value)
        ? "an array"
        : "an object";
  return new ArgumentError({
    code: "ARGUMENT_INVALID",
    file: name,
    cause: `it is ${given.slice(0, 40)}, and has to be ${wanted}`,
    fix: "see the reference of the function for what it takes",
  });
}

/** Classes of the point formats 6 to 10 (LAS 1.4 R15, table 17). */
const CLASSES = [
  ...["created, never classified", "unclassified", "ground", "low vegetation", "medium vegetation"],
  ...[
    "high vegetation",
    "building",
    "low point (noise)",
    "reserved",
    "water",
    "rail",
    "road surface",
    "reserved",
  ],
  ...["wire, guard", "wire, conductor", "transmission tower", "wire-structure connector", "bridge deck"],
  ...["high noise", "overhead structure", "ignored ground", "snow", "temporal exclusion"],
];

/** Classes of the point formats 0 to 5 that mean something else (LAS 1.4 R15, table 9). */
const LEGACY: Readonly<Record<number, string>> = { 8: "model key-point", 12: "overlap" };

/** Classes from here are the user's own. */
const FIRST_USER_CLASS = 64;

/** The ASPRS name of a class in a point format. */
export function className(code: number, pointFormat: number): string {
  if (code >= FIRST_USER_CLASS) return "user defined";
  return (pointFormat < 6 ? LEGACY[code] : undefined) ?? CLASSES[code] ?? "reserved";
}

/** Point format whose classes COPC files have. */
const COPC = 6;

/** Classes of a COPC file for people: their numbers, rising, and names. */
export function classesInWords(codes: Iterable<number>): string {
  const sorted = [...codes].sort((a, b) => a - b);
  return sorted.map((code) => `${code} (${className(code, COPC)})`).join(", ");
}

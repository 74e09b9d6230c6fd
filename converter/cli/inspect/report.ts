import type { Scan, ScanStatistics } from "../core/core.js";
import {
  accuracyInWords,
  density,
  type GeodeticBounds,
  heightInWords,
  placeInWords,
  remarks,
} from "../place/describe.js";
import { centreRow } from "../place/whereabouts.js";
import { className } from "../terminal/class-names.js";
import { atMost, count, counted, fixed, labelled, length, rounded, size } from "../terminal/output.js";
import { gpsSpanInWords } from "./gps-time.js";
import type { HeaderDetails } from "./header.js";
import type { Inspection } from "./inspect.js";
import type { Octree } from "./octree.js";

type Row = readonly [label: string, text: string];

/** What is known of a file, a line for each thing. */
export function report(inspection: Inspection): string[] {
  const { scan, header, statistics, sampled, gps, octree, octreeProblem } = inspection;
  const rows: Row[] = [
    ...fileRows(scan),
    ...placeRows(inspection),
    ...boundsRows(inspection),
    ...contentRows(scan, header, statistics, sampled),
    ...(gps ? [["gps time", gpsSpanInWords(gps)] as const] : []),
    ...(octree ? octreeRows(octree, scan.points, unitOf(0, inspection.place)) : []),
    ...(scan.copc || inspection.verified ? [["checksums", checksumsInWords(inspection)] as const] : []),
    ...(octreeProblem ? [["octree", octreeProblem] as const] : []),
    ...headed("records", header.records.map(recordInWords)),
    ...scan.warnings.map((text) => ["warning", text] as const),
  ];
  const width = Math.max(...rows.map(([label]) => label.length));
  return labelled(rows, width + 1);
}

/** The first row has the label, the others stand below it. */
function headed(label: string, texts: readonly string[]): Row[] {
  return texts.map((text, index) => [index === 0 ? label : "", text]);
}

function fileRows(scan: Scan): Row[] {
  const kind = scan.copc ? "COPC" : scan.compressed ? "LAZ" : "LAS";
  const each = scan.points > 0 ? `, ${rounded(scan.fileSize / scan.points, 3)} bytes per point` : "";
  const written = [scan.generatingSoftware, scan.systemIdentifier, scan.creation].filter(Boolean).join(", ");
  return [
    ["file", `${scan.file}  ${size(scan.fileSize)}${each}`],
    ["points", count(scan.points)],
    [
      "format",
      `${kind} ${scan.version}, point format ${scan.pointFormat}, ${scan.recordLength} bytes per record`,
    ],
    ["written", written || "not stated"],
  ];
}

function placeRows({ place, problem, whereabouts, accuracy }: Inspection): Row[] {
  if (!place) return [["place", problem?.message ?? "unknown"]];
  const { crs, basis, notes, operation } = place;
  const { horizontalUnit, verticalUnit } = crs;
  const assumed = verticalUnit.declared ? "" : " (assumed)";
  return [
    ["place", placeInWords(place)],
    ["from", basis],
    ...(operation ? [["operation", operation.name] as const] : []),
    ...centreRow(whereabouts),
    ...[...[...notes, ...whereabouts.notes].map(({ text }) => text), ...remarks(operation)].map(
      (text) => ["note", text] as const,
    ),
    ["units", `${horizontalUnit.name} in plane, ${verticalUnit.name} in height${assumed}`],
    ["height", heightInWords(crs, place.geoids)],
    ["accuracy", accuracy.length > 0 ? accuracyInWords(accuracy, crs) : "none, as there is no place"],
    ...accuracy.map(({ name, metres, note }): Row => {
      const worth = metres === null ? "unknown" : atMost(metres);
      return [`  ${name}`, `${worth}${note ? `  ${note}` : ""}`];
    }),
  ];
}

const axes = ["x", "y", "z"] as const;

function boundsRows({ scan, place, bounds }: Inspection): Row[] {
  const perArea = place && density(scan, place.crs);
  const range = (axis: number) =>
    [scan.min, scan.max].map((corner) => toStep(corner[axis]!, scan.scale[axis]!)).join(" … ");
  return [
    ["bounds", axes.map((name, axis) => `${name} ${range(axis)}`).join("   ")],
    ...(place
      ? [["on earth", bounds ? onEarth(bounds) : "no corner of the bounds can be placed"] as const]
      : []),
    ["step", axes.map((name, axis) => `${name} ${scan.scale[axis]} ${unitOf(axis, place)}`).join("   ")],
    ...(perArea === undefined
      ? []
      : [
          [
            "density",
            `${rounded(perArea, 3)} points per m², ${length(1 / Math.sqrt(perArea))} apart, over the rectangle of the bounds`,
          ] as const,
        ]),
  ];
}

/** Name of the unit of an axis. */
function unitOf(axis: number, place: Inspection["place"]): string {
  if (!place) return "(unit unknown)";
  return (axis < 2 ? place.crs.horizontalUnit : place.crs.verticalUnit).name;
}

function onEarth({ west, east, south, north, lowest, highest }: GeodeticBounds): string {
  const range = (from: number, to: number) => `${from.toFixed(6)} … ${to.toFixed(6)}°`;
  const height = `${fixed(lowest, 2)} … ${fixed(highest, 2)} m`;
  return `longitude ${range(west, east)}   latitude ${range(south, north)}   height ${height}`;
}

/** A coordinate with the digits that its step has: more of them are noise of binary fractions. */
function toStep(value: number, step: number): string {
  const digits = Math.min(12, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
  return Number.isFinite(value) && Number.isFinite(digits) ? value.toFixed(digits) : String(value);
}

function contentRows(
  scan: Scan,
  { returns }: HeaderDetails,
  statistics: ScanStatistics | undefined,
  sampled: string | undefined,
): Row[] {
  const numbered = returns.flatMap((points, index) => (points > 0 ? [[index + 1, points] as const] : []));
  const extra = scan.extraBytes.map(({ name, type }) => `${name} (${type})`).join(", ");
  return [
    ...(numbered.length > 0 ? [["returns", countsInWords(numbered)] as const] : []),
    ...(extra ? [["extra", extra] as const] : []),
    ...(statistics ? statisticsRows(scan, statistics) : []),
    ...(statistics && sampled
      ? [["", `classes, attributes and times of ${count(statistics.points)} points: ${sampled}`] as const]
      : []),
  ];
}

function statisticsRows(scan: Scan, { classes, rgbBits, attributes }: ScanStatistics): Row[] {
  const coloured = attributes.some(({ name }) => name === "red");
  const depth = rgbBits === 8 ? "8-bit colours in 16-bit fields" : "16-bit";
  // Where the points are is told already, and in more digits.
  const told = attributes.filter(({ name }) => !["x", "y", "z"].includes(name));
  return [
    ...headed(
      "classes",
      Object.entries(classes).map(
        ([code, points]) => `${code} ${className(Number(code), scan.pointFormat)}: ${count(points)}`,
      ),
    ),
    ["colours", coloured ? (rgbBits === null ? "all black" : depth) : "none"],
    ...headed(
      "attributes",
      told.map(
        ({ name, min, max, mean }) =>
          `${name} ${short(min)} … ${short(max)}, mean ${meanWithin(min, max, mean)}`,
      ),
    ),
  ];
}

/** A number without the noise of binary fractions. */
function short(value: number, digits = 12): string {
  return String(Number(value.toPrecision(digits)));
}

/** A mean with the digits that tell it from both ends of its range: with six, that of GPS times may lie outside. */
function meanWithin(min: number, max: number, mean: number): string {
  const [low, high] = [Number(short(min)), Number(short(max))];
  for (let digits = 6; digits < 12; digits++) {
    const rounded = Number(mean.toPrecision(digits));
    if (rounded >= low && rounded <= high && Math.abs(rounded - mean) <= (max - min) / 1000)
      return String(rounded);
  }
  return short(Math.min(high, Math.max(low, mean)));
}

function countsInWords(counts: readonly (readonly [number, number])[]): string {
  return counts.map(([key, points]) => `${key}: ${count(points)}`).join("   ");
}

function checksumsInWords({ scan, verified }: Inspection): string {
  if (!verified)
    return scan.checksums ? `${scan.checksums} of each node; --verify checks them` : "none stored";
  const what = `${counted(verified.parts, "chunk")} with ${counted(verified.points, "point")}`;
  return verified.checksums ? `${what} verified, all checksums match` : `none stored; ${what} decode`;
}

/** @param unit of x and y, in which the spacing is */
function octreeRows({ levels, whole }: Octree, expected: number, unit: string): Row[] {
  const nodes = levels.reduce((sum, level) => sum + level.nodes, 0);
  const points = levels.reduce((sum, level) => sum + level.points, 0);
  const missing = whole && points !== expected ? `, but the header announces ${count(expected)}` : "";
  const rest = whole ? "" : "; the rest of the hierarchy was not read";
  const rows = levels.map(
    (one) =>
      `level ${one.level}: ${counted(one.nodes, "node")}, ${counted(one.points, "point")}, spacing ${short(one.spacing, 3)} ${unit}`,
  );
  return headed("octree", [
    `${counted(nodes, "node")} with ${counted(points, "point")}${missing}${rest}`,
    ...rows,
  ]);
}

function recordInWords({
  userId,
  recordId,
  description,
  bytes,
  extended,
}: HeaderDetails["records"][number]): string {
  const text = description ? `, ${description}` : "";
  return `${userId} ${recordId}: ${size(bytes)}${extended ? ", after the points" : ""}${text}`;
}

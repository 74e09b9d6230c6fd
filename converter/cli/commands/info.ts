import {
  type AccuracyPart,
  accuracyParts,
  type Crs,
  CrsError,
  decodeRecord,
  statedAccuracy,
} from "@groma/georef";
import { type Scan, type ScanStatistics, scanFile } from "../core.js";
import { crsInWords, density, type GeodeticBounds, geodeticBounds, heightInWords } from "../describe.js";
import { georeference, TOLERANCE } from "../georeference.js";
import { count, length, size } from "../output.js";

/** What `groma info` knows of a file. */
interface Info {
  readonly scan: Scan;
  /** Undefined where the file says nothing, `problem` then tells. */
  readonly crs: Crs | undefined;
  readonly basis: string;
  readonly problem: CrsError | undefined;
  readonly bounds: GeodeticBounds | undefined;
  readonly accuracy: readonly AccuracyPart[];
  readonly statistics: ScanStatistics | undefined;
}

async function gather(file: string): Promise<Info> {
  const scan = await scanFile(file);
  const statistics = scan.groma?.["2"];
  const record = scan.groma?.["1"];
  if (record !== undefined) {
    const { crs, accuracy } = decodeRecord(Buffer.from(record, "base64"), file);
    const bounds = geodeticBounds(scan, crs);
    return { scan, crs, basis: "Groma's record", problem: undefined, bounds, accuracy, statistics };
  }
  try {
    const { crs, basis } = georeference(scan, {});
    const accuracy = accuracyParts(crs, scan.scale, TOLERANCE);
    return { scan, crs, basis, problem: undefined, bounds: geodeticBounds(scan, crs), accuracy, statistics };
  } catch (error) {
    if (!(error instanceof CrsError)) throw error;
    return {
      scan,
      crs: undefined,
      basis: "none",
      problem: error,
      bounds: undefined,
      accuracy: [],
      statistics,
    };
  }
}

/** The `info` command. A file without a usable CRS is described all the same; what is wrong with it is said. */
export async function runInfo(file: string, { json = false }: { json?: boolean }): Promise<void> {
  const info = await gather(file);
  process.stdout.write(json ? `${JSON.stringify(machineForm(info), undefined, 2)}\n` : personForm(info));
}

function machineForm({ scan, crs, basis, problem, bounds, accuracy, statistics }: Info) {
  const { groma: _, wkt: __, geoTiff: ___, ...header } = scan;
  return {
    ...header,
    crs: crs ?? null,
    crsFrom: basis,
    problem: problem?.toWire() ?? null,
    geodeticBounds: bounds ?? null,
    density: (crs && density(scan, crs)) ?? null,
    accuracy: statedAccuracy(accuracy),
    statistics: statistics ?? null,
  };
}

function personForm(info: Info): string {
  const lines = [...headerLines(info.scan), ...placeLines(info), ...contentLines(info.statistics)];
  const width = Math.max(...lines.map(([label]) => label.length));
  return lines.map(([label, text]) => `${label.padEnd(width)}  ${text}\n`).join("");
}

type Row = readonly [label: string, text: string];

function headerLines(scan: Scan): Row[] {
  const kind = scan.copc ? "COPC" : scan.compressed ? "LAZ" : "LAS";
  const extra = scan.extraBytes.map(({ name, type }) => `${name} (${type})`).join(", ");
  return [
    ["file", `${scan.file}  ${size(scan.fileSize)}`],
    ["points", count(scan.points)],
    [
      "format",
      `${kind} ${scan.version}, point format ${scan.pointFormat}, ${scan.recordLength} bytes a record`,
    ],
    ...(extra ? [["extra", extra] as const] : []),
    ["written", [scan.generatingSoftware, scan.creation].filter(Boolean).join(", ") || "not said"],
    ["step", `${scan.scale.join(", ")} source units`],
    ["bounds", axes.map((name, axis) => `${name} ${scan.min[axis]} … ${scan.max[axis]}`).join("   ")],
    ...scan.warnings.map((text) => ["warning", text] as const),
  ];
}

const axes = ["x", "y", "z"] as const;

function placeLines({ scan, crs, basis, problem, bounds, accuracy }: Info): Row[] {
  if (!crs || !bounds) return [["place", problem?.message ?? "unknown"]];
  const { horizontalUnit, verticalUnit } = crs;
  const perArea = density(scan, crs);
  const { total } = statedAccuracy(accuracy);
  const range = (from: number, to: number, digits: number) =>
    `${from.toFixed(digits)} … ${to.toFixed(digits)}`;
  return [
    ["place", `${crsInWords(crs)}  (from ${basis})`],
    [
      "units",
      `${horizontalUnit.name} in plane, ${verticalUnit.name} in height${verticalUnit.declared ? "" : " (assumed)"}`,
    ],
    ["height", heightInWords(crs)],
    [
      "on earth",
      `longitude ${range(bounds.west, bounds.east, 6)}°   latitude ${range(bounds.south, bounds.north, 6)}°`,
    ],
    ...(perArea === undefined ? [] : [["density", `${perArea.toPrecision(3)} points per m²`] as const]),
    ["accuracy", total === null ? "not known as a whole" : length(total)],
    ...accuracy.map(({ name, metres, note }) => {
      return [
        `  ${name}`,
        `${metres === null ? "unknown" : length(metres)}${note ? `  ${note}` : ""}`,
      ] as const;
    }),
  ];
}

function contentLines(statistics: ScanStatistics | undefined): Row[] {
  if (!statistics) return [];
  const classes = Object.entries(statistics.classes).map(([code, points]) => `${code}: ${count(points)}`);
  const ranges = statistics.attributes.map(({ name, min, max }) => `${name} ${min} … ${max}`);
  return [
    ["classes", classes.join("   ")],
    ["colours", statistics.rgbBits === null ? "none" : `${statistics.rgbBits} bits a channel`],
    ...ranges.map((text, index) => [index === 0 ? "attributes" : "", text] as const),
  ];
}

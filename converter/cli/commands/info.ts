import { type AccuracyPart, CrsError, statedAccuracy } from "@groma/georef";
import { type Scan, type ScanStatistics, scanFile } from "../core.js";
import {
  density,
  type GeodeticBounds,
  geodeticBounds,
  heightInWords,
  placeInWords,
  remarks,
} from "../describe.js";
import { count, length, size } from "../output.js";
import { type Placed, placed } from "../placed.js";

/** What `groma info` knows of a file. */
interface Info {
  readonly scan: Scan;
  /** Undefined where the file says nothing, `problem` then tells. */
  readonly place: Placed | undefined;
  readonly problem: CrsError | undefined;
  readonly bounds: GeodeticBounds | undefined;
  readonly accuracy: readonly AccuracyPart[];
  readonly statistics: ScanStatistics | undefined;
}

async function gather(file: string): Promise<Info> {
  const scan = await scanFile(file);
  const statistics = scan.groma?.["2"];
  try {
    const place = await placed(scan);
    const bounds = geodeticBounds(scan, place.truth);
    return { scan, place, problem: undefined, bounds, accuracy: place.accuracy, statistics };
  } catch (error) {
    if (!(error instanceof CrsError)) throw error;
    return { scan, place: undefined, problem: error, bounds: undefined, accuracy: [], statistics };
  }
}

/** The `info` command. A file without a usable CRS is described all the same; what is wrong with it is said. */
export async function runInfo(file: string, { json = false }: { json?: boolean }): Promise<void> {
  const info = await gather(file);
  process.stdout.write(json ? `${JSON.stringify(machineForm(info), undefined, 2)}\n` : personForm(info));
}

function machineForm({ scan, place, problem, bounds, accuracy, statistics }: Info) {
  const { groma, wkt: _, geoTiff: __, ...header } = scan;
  const bytes = (base64: string | undefined) => (base64 ? Buffer.byteLength(base64, "base64") : 0);
  return {
    ...header,
    crs: place?.crs ?? null,
    crsFrom: place?.basis ?? "none",
    problem: problem?.toWire() ?? null,
    engine: place?.engine ?? null,
    operation: place?.operation ?? null,
    geoids: place?.geoids ?? [],
    fitBound: place?.fitBound ?? null,
    geodeticBounds: bounds ?? null,
    density: (place && density(scan, place.crs)) ?? null,
    accuracy: statedAccuracy(accuracy),
    recordBytes: { georeference: bytes(groma?.["1"]), transformation: bytes(groma?.["3"]) },
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

function placeLines({ scan, place, problem, bounds, accuracy }: Info): Row[] {
  if (!place) return [["place", problem?.message ?? "unknown"]];
  const { crs, basis, operation } = place;
  const { horizontalUnit, verticalUnit } = crs;
  const perArea = density(scan, crs);
  const { total } = statedAccuracy(accuracy);
  return [
    ["place", placeInWords(place)],
    ["from", basis],
    ...(operation ? [["operation", operation.name] as const] : []),
    ...remarks(operation).map((text) => ["note", text] as const),
    [
      "units",
      `${horizontalUnit.name} in plane, ${verticalUnit.name} in height${verticalUnit.declared ? "" : " (assumed)"}`,
    ],
    ["height", heightInWords(crs, place.geoids)],
    ["on earth", bounds ? boundsInWords(bounds) : "no corner of the file's bounds has a place"],
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

function boundsInWords({ west, east, south, north }: GeodeticBounds): string {
  const range = (from: number, to: number) => `${from.toFixed(6)} … ${to.toFixed(6)}`;
  return `longitude ${range(west, east)}°   latitude ${range(south, north)}°`;
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

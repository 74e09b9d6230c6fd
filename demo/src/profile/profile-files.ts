import type { PointCloud } from "@groma/layer/cesium";
import {
  type ByteSink,
  type CutFacts,
  cutFacts,
  type ExportOptions,
  exportLandXml,
  exportPicture,
  exportPoints,
  exportSections,
  type GroundOptions,
  MemorySink,
  narrowed,
  type PictureFileOptions,
  type PointExportOptions,
} from "@groma/layer/export";
import { OFFSET, type PlotDrawing } from "@groma/layer/plot";
import { CrossSections, type Profile, StationEquations, stations } from "@groma/layer/tools";
import { i18n } from "../language/i18n.js";

/** What files of a profile are made with. */
export interface FileChoices extends ExportOptions {
  readonly title: string;
  readonly exaggeration: PictureFileOptions["exaggeration"];
  readonly ground: GroundOptions | undefined;
  /** Stations of the line, metres, where they are not its chainages. */
  readonly stations?: StationEquations | undefined;
  /** How its picture is drawn, and what it leaves out. */
  readonly drawing: PlotDrawing;
  /** Of cross-sections, metres. */
  readonly sections: { readonly interval: number; readonly width: number; readonly thickness: number };
}

type Write = (
  profile: Profile,
  sink: ByteSink,
  choices: FileChoices & { readonly facts: CutFacts },
) => Promise<unknown>;

interface FileFormat {
  readonly label: string;
  readonly ending: string;
  readonly write: Write;
}

/** Formats by what the page calls them; full density in all of them. */
export const FORMATS: ReadonlyMap<string, FileFormat> = new Map<string, FileFormat>([
  ["las", { label: "LAS", ending: "las", write: points({ format: "las" }) }],
  ["laz", { label: "LAZ", ending: "laz", write: points({ format: "laz" }) }],
  ["csv", { label: "CSV", ending: "csv", write: points({ format: "csv" }) }],
  ["geojson", { label: "GeoJSON", ending: "geojson", write: points({ format: "geojson" }) }],
  ["dxf", { label: i18n.t("DXF, in space"), ending: "dxf", write: points({ format: "dxf" }) }],
  [
    "dxf-straightened",
    {
      ...{ label: i18n.t("DXF, straightened"), ending: "dxf" },
      write: points({ format: "dxf", layout: "straightened" }),
    },
  ],
  [
    "xml",
    { label: "LandXML", ending: "xml", write: (profile, ...rest) => exportLandXml([profile], ...rest) },
  ],
  ["pdf", { label: i18n.t("PDF, to scale"), ending: "pdf", write: picture("pdf") }],
  ["svg", { label: i18n.t("SVG, to scale"), ending: "svg", write: picture("svg") }],
  ["png", { label: "PNG", ending: "png", write: writePng }],
  ["sections", { label: i18n.t("Cross-sections (ZIP)"), ending: "zip", write: writeSections }],
]);

/** Writes a file of a profile. @throws what exports throw */
export async function writeProfile(
  format: FileFormat,
  profile: Profile,
  sink: ByteSink,
  choices: FileChoices,
): Promise<void> {
  const { crs } = profile.origin as PointCloud;
  const facts = factsOf(profile, cutFacts(choices.title, crs));
  await format.write(profile, sink, { ...choices, ...stationsOf(profile, choices.stations), facts });
}

/** Stations in the unit of the profile's plane, for documents. */
function stationsOf({ unit }: Profile, stations: StationEquations | undefined) {
  if (!stations) return {};
  const equations = stations.equations.map(({ internal, ahead, ...equation }) => ({
    ...{ internal: internal / unit, ahead: ahead / unit },
    ...equation,
  }));
  const inUnit = new StationEquations(equations);
  return { equations, stationOf: (chainage: number) => inUnit.stationOf(chainage).station };
}

/** What documents say of the coordinates: those of the plane in which the line lies. */
function factsOf({ middle }: Profile, { epsg, ...facts }: CutFacts): CutFacts {
  if (!middle) return { ...facts, epsg };
  const about = middle.map((angle) => `${((angle * 180) / Math.PI).toFixed(4)}°`).join(", ");
  const crs = `transverse Mercator plane of WGS 84 about ${about}`;
  return { ...facts, crs, unit: { text: "m", size: 1 } };
}

function picture(format: "pdf" | "svg"): Write {
  return (profile, sink, options) => writePicture(profile, sink, options, format);
}

/** The picture as it is seen: coloured so, and without the points that a filter hides. */
async function writePicture(
  profile: Profile,
  sink: ByteSink,
  { drawing, ...options }: Parameters<Write>[2],
  format: "pdf" | "svg",
): Promise<unknown> {
  const paint = paintOf(profile, drawing);
  const seen = await narrowed(profile, { filter: drawing.filter });
  return exportPicture([seen], sink, { ...options, paint, format });
}

function points(how: Pick<PointExportOptions, "format" | "layout">): Write {
  return (profile, sink, { signal, onProgress }) =>
    exportPoints(profile, sink, { ...how, signal, onProgress });
}

/** How the points of a picture are coloured: as they are in the plot. */
function paintOf({ origin, strip: { reach } }: Profile, { style }: PlotDrawing) {
  const cloud = origin as PointCloud;
  const sides = { name: OFFSET, kind: "scalar", range: [-reach, reach] } as const;
  const rgbBits = cloud.statistics?.rgbBits ?? undefined;
  return { style, attributes: [sides, ...cloud.attributes], rgbBits };
}

/** The picture to scale, drawn by the browser at 200 dots per inch. */
async function writePng(...[profile, sink, options]: Parameters<Write>): Promise<void> {
  const svg = new MemorySink();
  await writePicture(profile, svg, options, "svg");
  const address = URL.createObjectURL(svg.blob("image/svg+xml"));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = new OffscreenCanvas(...dotsOf(image));
    canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
    const blob = await canvas.convertToBlob({ type: "image/png" });
    await sink.write(new Uint8Array(await blob.arrayBuffer()));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** Size at 200 dots per inch, of browsers' 96; no side longer than they can draw. */
function dotsOf({ naturalWidth, naturalHeight }: HTMLImageElement): [number, number] {
  const scale = Math.min(200 / 96, 16_000 / Math.max(naturalWidth, naturalHeight));
  return [Math.round(naturalWidth * scale), Math.round(naturalHeight * scale)];
}

async function writeSections(...[profile, sink, choices]: Parameters<Write>): Promise<void> {
  const { drawing, ...options } = choices;
  // In sections the distance from their own line says nothing of the profile's.
  const paint = drawing.style.color === OFFSET ? undefined : paintOf(profile, drawing);
  const { strip, origin, unit } = profile;
  const ends = [strip.chainages[0]!, strip.chainages[strip.chainages.length - 1]!] as const;
  const { interval, width, thickness } = options.sections;
  const half = width / 2 / unit;
  const sections = new CrossSections(strip, stations(...ends, { interval: interval / unit }), {
    ...{ left: half, right: half, thickness: thickness / unit },
  });
  const volume = profile.across(sections);
  await exportSections([{ origin, volume }], sink, {
    ...options,
    paint,
    line: profile.along,
    files: ["las", "dxf", "svg"],
  });
}

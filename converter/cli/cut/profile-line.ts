import { GromaError } from "@groma/georef";
import type { CutFacts } from "@groma/layer/export";
import type { RecordedPoints } from "@groma/layer/query";
import {
  type Corridor,
  CorridorOnEllipsoid,
  type CrossSections,
  CrossSectionsOnEllipsoid,
  type Geodetic,
  geodesicLengths,
  inUnit,
  lineOnEllipsoid,
  type StationEquation,
} from "@groma/layer/tools";
import { OptionError } from "../given/option-error.js";
import type { GivenLine } from "./line-file.js";
import {
  type GivenCrs,
  inSource,
  lengthsOnEarth,
  type Planes,
  planesOf,
  radiansOf,
  unitOf,
} from "./place.js";
import { corridor } from "./volumes.js";

const DEGREE = Math.PI / 180;

/** How a line is laid through files. */
export interface LineChoices {
  readonly line: GivenLine;
  readonly crs: GivenCrs;
  /** Of the strip: source units, or metres. */
  readonly width: number;
  /** How chainage is counted. */
  readonly stations: "grid" | "geodesic";
  /** Chainage at the start, which moves station equations too. Default: what its file says. */
  readonly start: number | undefined;
  /** In which plane points are decided: that of the files, where they have one in common, or one of the ellipsoid. */
  readonly plane: "source" | "ellipsoid";
  /** File of the line, for errors. */
  readonly given: string;
}

/** A line as it lies in the plane of one file. */
export interface LaidLine {
  readonly strip: Corridor;
  /** Where stations are counted anew, in its chainage. */
  readonly equations: readonly StationEquation[];
  /** Units of that plane for a unit of the lengths that were given. */
  readonly unit: number;
  /** The plane on the ellipsoid that the strip lies in; undefined: that of the file. */
  readonly ellipsoid: OnEllipsoid | undefined;
}

/** What brings a strip in a plane of the ellipsoid to a file. */
export interface OnEllipsoid {
  corridor(strip: Corridor): CorridorOnEllipsoid;
  sections(sections: CrossSections): CrossSectionsOnEllipsoid;
  /** What documents say of coordinates in that plane. */
  facts(facts: CutFacts): CutFacts;
}

/**
 * Lays a line through one of several files.
 * @throws OptionError OPTION_CRS, OPTION_LINE, OPTION_STATIONS; CrsError, RecordError, PlacementError
 */
export async function layLine(
  origin: RecordedPoints,
  all: readonly RecordedPoints[],
  choices: LineChoices,
): Promise<LaidLine> {
  const { line, crs, width, plane, given } = choices;
  const { angles, different } = await known(all, crs);
  const onEllipsoid = plane === "ellipsoid" || different || (angles && crs !== "source");
  if (!onEllipsoid) return inPlaneOf(origin, choices);
  if (crs === "source") {
    throw new OptionError({
      ...{
        code: "OPTION_CRS",
        file: given,
        cause: "files without a common plane have no coordinates for a line",
      },
      fix: "give the line in longitude and latitude, with --line-crs EPSG:4326",
    });
  }
  const radians = line.vertices.map(([x, y]) => [x * DEGREE, y * DEGREE] as const);
  const { plane: local, middle, vertices: positions } = lineOnEllipsoid(radians, given);
  const lengths = choices.stations === "geodesic" ? geodesicLengths(radians) : undefined;
  const { start, equations } = stationsOf(inUnit(line, 1), choices.start);
  const strip = corridor({ positions, unit: 1 }, width, { lengths, start }, given);
  const geodetic: Geodetic = await radiansOf(origin);
  const { boundingBox } = origin.source;
  const about = middle.map((angle) => `${(angle / DEGREE).toFixed(4)}°`).join(", ");
  return {
    ...{ strip, equations, unit: 1 },
    ellipsoid: {
      corridor: (inner) => new CorridorOnEllipsoid(inner, local, geodetic, boundingBox),
      sections: (inner) => new CrossSectionsOnEllipsoid(inner, local, geodetic, boundingBox),
      facts: ({ epsg: _epsg, ...facts }) => ({
        ...facts,
        crs: `transverse Mercator plane of WGS 84 about ${about}`,
        unit: { text: "m", size: 1 },
      }),
    },
  };
}

/** What planes files have; a line in their own coordinates does not need to know, where they do not say. */
async function known(all: readonly RecordedPoints[], crs: GivenCrs): Promise<Planes> {
  try {
    return await planesOf(all);
  } catch (error) {
    if (crs === "source" && error instanceof GromaError) return { angles: false, different: false };
    throw error;
  }
}

/** In the plane of the file's own coordinates, whose unit chainages have, those along geodesics too. */
async function inPlaneOf(origin: RecordedPoints, choices: LineChoices): Promise<LaidLine> {
  const { crs, width, given } = choices;
  const geodesic = choices.stations === "geodesic";
  const own = geodesic || choices.line.unit !== undefined ? await unitOf(origin) : undefined;
  const line = own === undefined ? choices.line : inUnit(choices.line, own);
  const { vertices } = crs === "source" ? line : choices.line;
  const onEarth = geodesic ? await lengthsOnEarth(vertices, crs, origin) : undefined;
  const { positions, unit } = await inSource(vertices, crs, origin, given);
  const { lengths, headings } = crs === "source" ? line : { lengths: undefined, headings: undefined };
  const counted = onEarth?.map((metres) => metres / (own ?? 1)) ?? lengths;
  const { start, equations } = stationsOf(line, choices.start);
  const stationing = { lengths: counted, headings, start };
  const strip = corridor({ positions, unit }, width, stationing, given);
  return { strip, equations, unit, ellipsoid: undefined };
}

/** Where a line's stations begin and are counted anew; from another start on, the equations stay where they are on the ground. */
function stationsOf(
  { start: own, equations }: Pick<GivenLine, "start" | "equations">,
  start = own,
): { readonly start: number; readonly equations: readonly StationEquation[] } {
  const moved = ({ internal, ...equation }: StationEquation) => ({
    ...equation,
    internal: internal + start - own,
  });
  return { start, equations: start === own ? equations : equations.map(moved) };
}

import { type CutFacts, coordinatesInWords } from "./cut-facts.js";
import { escaped } from "./picture/svg.js";
import type { AlongLine } from "./selection.js";

/** Stretches of ground without a gap: pairs of numbers along and up. */
export type GroundRuns = readonly (readonly (readonly [along: number, height: number])[])[];

/** A cross-section as LandXML has it. */
export interface LandXmlSection {
  readonly station: number;
  readonly name: string;
  /** Distances from the line, right positive, and heights. */
  readonly ground: GroundRuns;
}

/** What a LandXML file of a profile says. */
export interface LandXmlContent {
  readonly facts: CutFacts;
  readonly line: AlongLine;
  /** Ground along the line, by chainage. */
  readonly ground?: GroundRuns | undefined;
  readonly sections?: readonly LandXmlSection[] | undefined;
  /** From which chainages on stations are counted anew, as `StationEquation` of `@groma/layer/tools`. */
  readonly equations?:
    | readonly {
        readonly internal: number;
        readonly ahead: number;
        readonly increment?: "increasing" | "decreasing" | undefined;
      }[]
    | undefined;
  /** How the ground follows from the points, in words. */
  readonly method: string;
  /** When the file was made. */
  readonly date: Date;
}

/** Digits of lengths: a hundredth of a millimetre. */
const DIGITS = 5;

const METRIC =
  '<Metric areaUnit="squareMeter" linearUnit="meter" volumeUnit="cubicMeter" temperatureUnit="celsius" pressureUnit="milliBars"/>';
const imperial = (linear: string) =>
  `<Imperial areaUnit="squareFoot" linearUnit="${linear}" volumeUnit="cubicYard" temperatureUnit="fahrenheit" pressureUnit="inHG"/>`;

/** Units that LandXML has a word for, by their size in metres; lengths in any other are written in metres. */
const UNITS = [
  { size: 1, element: METRIC },
  { size: 0.3048, element: imperial("foot") },
  { size: 1200 / 3937, element: imperial("USSurveyFoot") },
] as const;

/**
 * A profile and its cross-sections as LandXML 1.2: the line as an Alignment of Lines, the ground along it as ProfSurf, that
 * of the sections as CrossSectSurf. Coordinates are northing, then easting; distances in sections are negative to the left. Heights
 * are in the unit of lengths, since most readers know no other. Gaps are gaps: a list for each stretch; stretches of
 * one station are left out.
 */
export function* landXmlOf({
  facts,
  line,
  ground,
  sections,
  equations,
  method,
  date,
}: LandXmlContent): Generator<string> {
  const known = UNITS.find(({ size }) => Math.abs(size - facts.unit.size) < 1e-9 * size) ?? UNITS[0];
  const factor = facts.unit.size / known.size;
  const heights = facts.heightUnit.size / known.size;
  const length = (value: number) => (value * factor).toFixed(DIGITS);
  const height = (value: number) => (value * heights).toFixed(DIGITS);
  const place = ([x, y]: readonly [number, number]) => `${length(y)} ${length(x)}`;
  const first = line.chainages[0];
  const last = line.chainages[line.chainages.length - 1];
  const title = escaped(facts.title);
  const instant = date.toISOString();
  yield '<?xml version="1.0" encoding="UTF-8"?>\n';
  yield `<LandXML xmlns="http://www.landxml.org/schema/LandXML-1.2" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:schemaLocation="http://www.landxml.org/schema/LandXML-1.2 http://www.landxml.org/schema/LandXML-1.2/LandXML-1.2.xsd" version="1.2" date="${instant.slice(0, 10)}" time="${instant.slice(11, 19)}" language="English" readOnly="false">\n`;
  yield `<Units>${known.element}</Units>\n`;
  const code = facts.epsg === undefined ? "" : ` epsgCode="${facts.epsg}"`;
  yield `<CoordinateSystem name="${escaped(facts.crs ?? "unknown")}"${code} desc="${escaped(coordinatesInWords(facts))}"/>\n`;
  yield `<Project name="${title}"/>\n<Application name="Groma"/>\n`;
  yield `<Alignments>\n<Alignment name="${title}" length="${length(last - first)}" staStart="${length(first)}">\n<CoordGeom>\n`;
  for (let index = 1; index < line.vertices.length; index++) {
    if (line.chainages[index] === line.chainages[index - 1]) continue;
    const ends = `<Start>${place(line.vertices[index - 1])}</Start><End>${place(line.vertices[index])}</End>`;
    yield `<Line length="${length(line.chainages[index] - line.chainages[index - 1])}" staStart="${length(line.chainages[index - 1])}">${ends}</Line>\n`;
  }
  yield "</CoordGeom>\n";
  for (const { internal, ahead, increment = "increasing" } of equations ?? [])
    yield `<StaEquation staInternal="${length(internal)}" staAhead="${length(ahead)}" staIncrement="${increment}"/>\n`;
  const surface = (element: string, runs: GroundRuns) => {
    const lists = runs.filter((run) => run.length > 1);
    if (lists.length === 0) return "";
    const points = lists.map((run) => {
      const pairs = run.map(([along, up]) => `${length(along)} ${height(up)}`);
      return `<PntList2D>${pairs.join(" ")}</PntList2D>\n`;
    });
    return `<${element} name="ground" desc="${escaped(method)}" state="existing">\n${points.join("")}</${element}>\n`;
  };
  const along = ground ? surface("ProfSurf", ground) : "";
  if (along !== "") yield `<Profile name="${title}">\n${along}</Profile>\n`;
  if (sections && sections.length > 0) {
    yield `<CrossSects name="${title}">\n`;
    for (const { station, name, ground: runs } of sections) {
      const content = surface("CrossSectSurf", runs);
      yield `<CrossSect sta="${length(station)}" name="${escaped(name)}">\n${content}</CrossSect>\n`;
    }
    yield "</CrossSects>\n";
  }
  yield "</Alignment>\n</Alignments>\n</LandXML>\n";
}

import { SaxesParser } from "saxes";
import { type Alignment, CLOSURE, noAlignment, theOne } from "./alignment.js";
import { CurveLine } from "./curves.js";
import type { StationEquation } from "./station-equations.js";

type Place = readonly [x: number, y: number];

/** An element that is being read. */
interface Element {
  readonly name: string;
  readonly attributes: ReadonlyMap<string, string>;
  /** Places of its children by their names: Start, Center, PI, End. */
  readonly places: Map<string, Place>;
  text: string;
}

interface Found {
  readonly name: string;
  readonly start: number;
  line: CurveLine | undefined;
  readonly equations: StationEquation[];
}

/** Metres in LandXML's units of length, whose names some programs write in other letters. */
const UNITS: ReadonlyMap<string, number> = new Map([
  ["meter", 1],
  ["millimeter", 0.001],
  ["centimeter", 0.01],
  ["kilometer", 1000],
  ["foot", 0.3048],
  ["ussurveyfoot", 1200 / 3937],
  ["inch", 0.0254],
  ["mile", 1609.344],
]);

/** By how much a part may begin away from the end of the one before, in the unit of the file. */
const GAP = 0.01;

/**
 * Reads the horizontal alignment of a LandXML file (1.0 to 1.2): lines, arcs, clothoids and irregular lines of its CoordGeom,
 * its station at the start and its station equations. Places may be references to named CgPoints.
 *
 * @param name of the alignment; undefined where the file has one alone
 * @param file for errors
 * @throws FormatError FORMAT_ALIGNMENT where it is no such file, has no such alignment, or one with gaps or other spirals
 */
export function readLandXml(text: string, name: string | undefined, file: string): Alignment {
  const reader = new Reader(file);
  const parser = new SaxesParser();
  parser.on("opentag", ({ name: tag, attributes }) =>
    reader.open(
      localName(tag),
      new Map(Object.entries(attributes).map(([key, value]) => [key, String(value)])),
    ),
  );
  parser.on("text", (part) => reader.text(part));
  parser.on("closetag", () => reader.close());
  parser.on("error", (error) => {
    throw noAlignment(
      file,
      `it is no well-formed XML (${error.message})`,
      "Export the alignment as LandXML again",
    );
  });
  parser.write(text).close();
  const { line, ...found } = theOne(
    reader.alignments.filter((one) => one.line !== undefined),
    name,
    file,
  );
  const { vertices, lengths, headings } = line!;
  return { ...found, vertices, lengths, headings, unit: reader.unit };
}

const localName = (tag: string): string => tag.slice(tag.indexOf(":") + 1);

class Reader {
  readonly alignments: Found[] = [];
  unit: number | undefined;
  readonly #file: string;
  readonly #stack: Element[] = [];
  readonly #points = new Map<string, Place>();

  constructor(file: string) {
    this.#file = file;
  }

  open(name: string, attributes: ReadonlyMap<string, string>): void {
    this.#stack.push({ name, attributes, places: new Map(), text: "" });
    const unit = attributes.get("linearUnit");
    if ((name === "Metric" || name === "Imperial") && unit !== undefined) {
      this.unit = UNITS.get(unit.toLowerCase());
      if (this.unit === undefined) throw this.#refusal(`its unit of length is not known: ${unit}`);
    }
    if (name === "Alignment") {
      const station = attributes.get("staStart") ?? "0";
      const start = numberOf(station);
      if (!Number.isFinite(start)) throw this.#refusal(`its staStart is no number: ${station}`);
      this.alignments.push({ name: attributes.get("name") ?? "", start, line: undefined, equations: [] });
    }
  }

  text(part: string): void {
    const element = this.#stack[this.#stack.length - 1];
    if (element) element.text += part;
  }

  close(): void {
    const element = this.#stack.pop()!;
    const parent = this.#stack[this.#stack.length - 1];
    switch (element.name) {
      case "CgPoint": {
        const key = element.attributes.get("name");
        const place = placeOf(element.text);
        if (key !== undefined && place) this.#points.set(key, place);
        return;
      }
      case "Start":
      case "End":
      case "Center":
      case "PI": {
        const place = placeOf(element.text) ?? this.#points.get(element.attributes.get("pntRef") ?? "");
        if (place) parent?.places.set(element.name, place);
        return;
      }
      case "PntList2D":
      case "PntList3D":
        if (parent?.name === "IrregularLine") parent.text = `${element.name} ${element.text}`;
        return;
      case "StaEquation":
        this.#equation(element);
        return;
      default:
        if (parent?.name === "CoordGeom" && this.#within("Alignment")) this.#part(element);
    }
  }

  #within(name: string): boolean {
    return this.#stack.some((element) => element.name === name);
  }

  #equation({ attributes }: Element): void {
    const [internal, ahead] = ["staInternal", "staAhead"].map((key) => numberOf(attributes.get(key)));
    if (!Number.isFinite(internal + ahead)) throw this.#refusal("a station equation of it has no numbers");
    const increment = attributes.get("staIncrement") === "decreasing" ? "decreasing" : "increasing";
    const equations = this.alignments[this.alignments.length - 1]?.equations;
    if (equations?.some((other) => other.internal === internal))
      throw this.#refusal(`it has two station equations at ${internal}`);
    equations?.push({ internal, ahead, increment });
  }

  #part(element: Element): void {
    const { name } = element;
    if (name === "Feature") return;
    const alignment = this.alignments[this.alignments.length - 1];
    const [start, end] = [this.#place(element, "Start"), this.#place(element, "End")];
    alignment.line ??= new CurveLine(start);
    const { line } = alignment;
    const [x, y] = line.end;
    if (Math.hypot(start[0] - x, start[1] - y) > GAP)
      throw this.#refusal(
        `a ${name} of alignment "${alignment.name}" begins away from the end of the one before`,
      );
    if (name === "Line") line.lineTo(end);
    else if (name === "Curve") this.#curve(line, element, end);
    else if (name === "Spiral") this.#spiral(line, element, end);
    else if (name === "IrregularLine") this.#irregular(line, element, end);
    else throw this.#refusal(`alignment "${alignment.name}" has a part that is not known: ${name}`);
  }

  #curve(line: CurveLine, element: Element, end: Place): void {
    const centre = this.#place(element, "Center");
    const [x, y] = line.end;
    const radius = Math.hypot(x - centre[0], y - centre[1]);
    const other = Math.hypot(end[0] - centre[0], end[1] - centre[1]);
    if (!(Math.abs(radius - other) <= CLOSURE))
      throw this.#refusal("both ends of a Curve have other distances from its centre");
    const hand = this.#hand(element);
    const angle =
      Math.atan2(end[1] - centre[1], end[0] - centre[0]) - Math.atan2(y - centre[1], x - centre[0]);
    const full = 2 * Math.PI;
    const turn = (((hand * angle) % full) + full) % full;
    const isCircle = numberOf(element.attributes.get("length")) > Math.PI * radius;
    // Where an arc has no length, its end may lie a gap and a rounding before the line's: that is no whole circle.
    if (!isCircle && (full - turn) * radius <= 2 * GAP) return;
    const whole = isCircle && turn * radius <= 2 * GAP ? full : 0;
    if (turn + whole > 0) line.arcTo(end, centre, hand * (turn + whole));
  }

  /** 1 for what turns to the left, -1 for what turns to the right. */
  #hand({ name, attributes }: Element): 1 | -1 {
    const rot = attributes.get("rot")?.toLowerCase();
    if (rot === "ccw") return 1;
    if (rot === "cw") return -1;
    throw this.#refusal(`a ${name} of it turns neither cw nor ccw`);
  }

  #spiral(line: CurveLine, element: Element, end: Place): void {
    const { attributes } = element;
    const type = attributes.get("spiType") ?? "clothoid";
    if (type !== "clothoid") throw this.#refusal(`it has a spiral of type ${type}; clothoids are known`);
    const length = numberOf(attributes.get("length"));
    const [x, y] = line.end;
    if (length === 0 && Math.hypot(end[0] - x, end[1] - y) <= 2 * GAP) return;
    const hand = this.#hand(element);
    const [first, last] = ["radiusStart", "radiusEnd"].map((key) => hand * curvatureOf(attributes.get(key)));
    const corner = this.#place(element, "PI");
    const heading = Math.atan2(corner[1] - y, corner[0] - x);
    const miss = line.clothoidTo(end, heading, length, first, last);
    if (!(miss <= CLOSURE))
      throw this.#refusal(`a clothoid of length ${length} ends ${miss.toFixed(3)} away from its End`);
  }

  #irregular(line: CurveLine, { text }: Element, end: Place): void {
    const [kind, ...words] = text.trim().split(/\s+/);
    const step = kind === "PntList3D" ? 3 : 2;
    for (let at = 0; at + 1 < words.length; at += step) {
      const place = placeOf(`${words[at]} ${words[at + 1]}`);
      if (!place) throw this.#refusal("an IrregularLine of it has a place without numbers");
      const [x, y] = line.end;
      if (place[0] !== x || place[1] !== y) line.lineTo(place);
    }
    const [x, y] = line.end;
    if (end[0] !== x || end[1] !== y) line.lineTo(end);
  }

  #place({ name, places }: Element, which: string): Place {
    const found = places.get(which);
    if (found) return found;
    throw this.#refusal(`a ${name} of it has no ${which}`);
  }

  #refusal(cause: string) {
    return noAlignment(this.#file, cause, "Export the alignment again, or give it as a polyline");
  }
}

/** Northing, then easting, as LandXML has them. */
function placeOf(text: string): Place | undefined {
  const [north, east] = text.trim().split(/\s+/).map(Number);
  return Number.isFinite(north) && Number.isFinite(east) ? [east, north] : undefined;
}

/** NaN where there is none, or nothing in it. */
function numberOf(text: string | undefined): number {
  return text === undefined || text.trim() === "" ? Number.NaN : Number(text);
}

/** 1 / radius; an infinite radius is straight. */
function curvatureOf(radius: string | undefined): number {
  if (radius === undefined || /^[+-]?INF/i.test(radius.trim())) return 0;
  return 1 / Number(radius);
}

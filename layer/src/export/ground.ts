import { TerrainLine, type TerrainOptions, type TerrainStatistic } from "../tools/terrain/terrain-line.js";
import { eachAlong, eachPainted, type PaintOptions, type PointAlong } from "./along.js";
import { type CutFacts, coordinatesInWords, type LengthUnit } from "./cut-facts.js";
import type { GroundRuns } from "./landxml.js";
import type { PictureWords } from "./picture/layout.js";
import { type PictureScale, ProfilePicture } from "./picture/profile-picture.js";
import type { Sheet } from "./picture/sheet.js";
import { type ExportOptions, type PointSelection, spacingOf } from "./selection.js";

/** How the ground is found that documents show. */
export interface GroundOptions extends TerrainOptions {
  /** Classes of its points. Default: all. */
  readonly classes?: ReadonlySet<number> | undefined;
}

/** What of the points along a line was taken for the ground. */
export interface GroundFound {
  /** Points of the classes that were asked for. */
  readonly points: number;
  /** Classes of the other points, rising. */
  readonly others: readonly number[];
}

/** What documents about a cut are made with. */
export interface DocumentOptions extends ExportOptions, PictureScale, PaintOptions {
  /** What the document says of the cut: where it is from, its units, its place. */
  readonly facts: CutFacts;
  /** Default of LandXML: stations every metre, the percentile 25. Of pictures: none is drawn. */
  readonly ground?: GroundOptions | undefined;
  /** Told of each ground that is made of points of some classes: where there are none, it is nowhere. */
  readonly onGround?: ((found: GroundFound) => void) | undefined;
}

/** What the horizontal axis of a sheet has. */
export interface SheetAxis extends Pick<PictureWords, "stationOf"> {
  readonly word: string;
}

/** The ends of a line along which points lie. */
export interface AlongSpan {
  readonly from: number;
  readonly to: number;
}

/** Classes that a record can have. */
const CLASSES = 256;

/** The ground along a line, of the points of some classes. */
class GroundLine {
  readonly #line: TerrainLine;
  readonly #classes: ReadonlySet<number> | undefined;
  /** Whether a point of a class was left out, by the class. */
  readonly #others = new Uint8Array(CLASSES);
  #points = 0;

  constructor({ from, to }: AlongSpan, { classes, ...terrain }: GroundOptions) {
    this.#line = new TerrainLine(from, to, terrain);
    this.#classes = classes;
  }

  add({ chainage, height, classification }: PointAlong): void {
    if (!this.#classes || (classification !== undefined && this.#classes.has(classification))) {
      this.#line.add(chainage, height);
      this.#points++;
    } else if (classification !== undefined) this.#others[classification] = 1;
  }

  /** The ground, once all points are in. @param onGround as {@link DocumentOptions.onGround} */
  runs(onGround: DocumentOptions["onGround"]): GroundRuns {
    if (this.#classes) {
      const others = [...this.#others.keys()].filter((one) => this.#others[one] > 0);
      onGround?.({ points: this.#points, others });
    }
    return this.#line.runs();
  }
}

/** The ground along a line. @throws as {@link eachAlong}; RangeError where the options are none */
export async function groundOf(
  selections: readonly PointSelection[],
  span: AlongSpan,
  ground: GroundOptions,
  { onGround, ...options }: ExportOptions & Pick<DocumentOptions, "onGround"> = {},
): Promise<GroundRuns> {
  const line = new GroundLine(span, ground);
  await eachAlong(selections, options, (point) => line.add(point));
  return line.runs(onGround);
}

/**
 * Draws the points of selections along a line.
 * @param along what the horizontal axis has
 * @returns the sheet, and the ground where it was asked for
 * @throws as {@link eachAlong}; RangeError where the options are none; FormatError EXPORT_PICTURE
 */
export async function drawSheet(
  selections: readonly PointSelection[],
  { from, to }: AlongSpan,
  title: string,
  { word, stationOf }: SheetAxis,
  { facts, ground, scale, exaggeration, onGround, ...options }: DocumentOptions,
): Promise<{ readonly sheet: Sheet; readonly ground: GroundRuns | undefined }> {
  const file = selections[0]?.origin.name ?? facts.title;
  const [unit, heightUnit] = [facts.unit.size, facts.heightUnit.size];
  const picture = new ProfilePicture({ from, to, unit, heightUnit, scale, exaggeration, file });
  const line = ground && new GroundLine({ from, to }, ground);
  const count = await eachPainted(selections, options, (point) => {
    const { chainage, height, offset, red, green, blue } = point;
    picture.add(chainage, height, offset, red, green, blue);
    line?.add(point);
  });
  const runs = line?.runs(onGround);
  const thinned = spacingOf(selections);
  const words = {
    title,
    facts: [
      [...new Set(selections.map(({ origin }) => origin.name.split(/[\\/]/).pop()))].join(", "),
      coordinatesInWords(facts),
      `${count.toLocaleString("en")} points${thinned === 0 ? "" : `, ${thinnedInWords(thinned, facts.unit)}`}`,
      ...(ground ? [`line: ${groundInWords(ground, facts.unit)}`] : []),
    ],
    unit: facts.unit.text,
    along: `${word} (${facts.unit.text})`,
    stationOf,
    up: `height (${[facts.heightUnit.text, facts.heights].filter(Boolean).join(", ")})`,
  };
  return { sheet: picture.sheet(words, runs), ground: runs };
}

/** What documents say of points that were left out. */
export function thinnedInWords(spacing: number, { text }: LengthUnit): string {
  return `thinned: one in about ${spacing} ${text}`;
}

/** How the ground follows from the points. */
export function groundInWords(
  { interval, statistic = 25, classes }: GroundOptions,
  { text }: LengthUnit,
): string {
  const which = classes
    ? `points of ${classes.size === 1 ? "class" : "classes"} ${[...classes].join(", ")}`
    : "all points";
  return `${statisticInWords(statistic)} of the heights of ${which}, every ${interval} ${text}`;
}

function statisticInWords(statistic: TerrainStatistic): string {
  if (typeof statistic === "number") return `percentile ${statistic}`;
  return { min: "least", max: "greatest", mean: "mean" }[statistic];
}

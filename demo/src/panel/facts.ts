import type { AccuracyPart, OperationReport } from "@groma/georef";
import { printable } from "@groma/georef/printable";
import type { PointCloud, PointCloudLayer, SourceWarning } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { type Note, noteWords } from "../language/note-words.js";
import { byId, setText, textElement } from "./elements.js";
import {
  accuracyWords,
  countWords,
  crsWords,
  engineWords,
  heightWords,
  lackingWords,
  lengthWords,
  type Words,
  warningsOf,
} from "./words.js";

/** What the page itself did for a cloud. */
export interface Own {
  /** Whether the reader gave its coordinate system. */
  readonly given: boolean;
  /** Tells of the octree that was made here, where it was. */
  readonly octree: HTMLElement | undefined;
}

/** Writes what a cloud is, where it is and what that is worth. */
export function showFacts({ cloud, nodeLoaded }: PointCloudLayer, { given, octree }: Own): void {
  const { name, pointCount, crs, geoids, operation, accuracy } = cloud;
  setText(byId("title", HTMLHeadingElement), name);
  document.title = `${printable(name)} · Groma`;
  const remark = accuracy.parts.find((part) => part.name === "height")?.note;
  const doubts = document.createElement("div");
  showDoubts(doubts, cloud.warnings);
  // Some of what a file says of itself is refuted only by the points that arrive.
  let shown = cloud.warnings;
  nodeLoaded.addEventListener(() => {
    if (cloud.warnings === shown) return;
    shown = cloud.warnings;
    showDoubts(doubts, shown);
  });
  const facts = byId("facts", HTMLDListElement);
  facts.replaceChildren(
    ...fact(i18n.t("Points"), { text: countWords(pointCount) }, doubts, ...(octree ? [octree] : [])),
    ...named(i18n.t("Coordinate system"), crsWords(crs, { given })),
    ...fact(i18n.t("Height"), heightWords(crs, { geoids, remark })),
    ...fact(
      i18n.t("Placed by"),
      engineWords(cloud),
      ...warningsOf(operation, { remark }).map((note) => noteElement(note, "warning")),
      ...operationOf(operation),
      ...lackingOf(operation),
    ),
    ...fact(i18n.t("Accuracy"), accuracyWords(accuracy), partsOf(accuracy.parts)),
  );
  setText(byId("about-words", HTMLSpanElement), aboutWords(cloud));
  // What a file is refuted of is not folded away.
  byId("about", HTMLDetailsElement).open = cloud.warnings.length > 0;
}

/** The page's title while no cloud is there. */
export function clearTitle(): void {
  setText(byId("title", HTMLHeadingElement), "Groma");
  document.title = "Groma";
}

/** In short, what a cloud is and what its place is worth. */
function aboutWords({ pointCount, accuracy }: PointCloud): string {
  return i18n.t("{count, plural, one {# point} other {# points}}, accuracy {accuracy}", {
    count: pointCount,
    accuracy: accuracyWords(accuracy).text,
  });
}

/** Writes what a data set says of itself and does not hold. */
function showDoubts(place: HTMLElement, warnings: readonly SourceWarning[]): void {
  place.replaceChildren(...warnings.map(({ message }) => noteElement(noteWords(message), "warning")));
}

function fact(term: string, { text, note, doubt }: Words, ...more: HTMLElement[]): HTMLElement[] {
  const value = textElement("dd", text);
  if (note) value.append(textElement("small", note));
  if (doubt) value.append(noteElement(doubt, "warning"));
  value.append(...more);
  return [textElement("dt", term), value];
}

/** A fact that is a name: registries have them in English. */
function named(term: string, { text, note }: Words): HTMLElement[] {
  const [title, value] = fact(term, note === undefined ? { text: "" } : { text: "", note });
  value!.prepend(nameElement(text));
  return [title!, value!];
}

function nameElement(name: string): HTMLElement {
  const element = textElement("span", name);
  element.lang = "en";
  return element;
}

/** The name of the operation, a step after the other, folded away. */
function operationOf(operation: OperationReport | undefined): HTMLElement[] {
  if (!operation) return [];
  const steps = operation.name.split(" + ").map((step) => row([nameElement(step)], undefined));
  return [folded(i18n.t("operation"), steps)];
}

/** The operations that would have been better, folded away; nothing where there are none. */
function lackingOf(operation: OperationReport | undefined): HTMLElement[] {
  const lacking = lackingWords(operation);
  if (lacking.length === 0) return [];
  const items = lacking.map(({ text, note }) =>
    row([nameElement(text)], note === undefined ? undefined : { text: note, translated: true }),
  );
  return [
    folded(
      i18n.t("{count, plural, one {# better operation} other {# better operations}}, grids missing", {
        count: lacking.length,
      }),
      items,
    ),
  ];
}

/** The parts of an accuracy, folded away. */
function partsOf(parts: readonly AccuracyPart[]): HTMLElement {
  const items = parts.map(({ name, metres, note }) =>
    row(
      [textElement("span", libraryWords(name)), textElement("span", lengthWords(metres))],
      note === undefined ? undefined : noteWords(note),
    ),
  );
  return folded(i18n.t("{count, plural, one {# part} other {# parts}}", { count: parts.length }), items);
}

function row(cells: readonly HTMLElement[], note: Note | undefined): HTMLElement {
  const item = document.createElement("li");
  item.append(...cells);
  if (note) item.append(noteElement(note));
  return item;
}

/** A remark of the libraries. */
function noteElement({ text, translated }: Note, className?: string): HTMLElement {
  const element = textElement("small", text, className);
  if (!translated) element.lang = "en";
  return element;
}

/** A list under a line that opens it. */
function folded(summary: string, items: readonly HTMLElement[]): HTMLElement {
  const details = document.createElement("details");
  details.className = "parts";
  const list = document.createElement("ul");
  list.append(...items);
  details.append(textElement("summary", summary), list);
  return details;
}

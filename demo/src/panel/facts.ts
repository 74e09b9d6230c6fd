import type { AccuracyPart } from "@groma/georef";
import type { PointCloud } from "@groma/layer/cesium";
import { byId, textElement } from "./elements.js";
import { accuracyWords, countWords, crsWords, heightWords, lengthWords, type Words } from "./words.js";

/** Writes what a cloud is, where it is and what that is worth. */
export function showFacts({ name, pointCount, crs, basis, accuracy }: PointCloud): void {
  byId("title", HTMLHeadingElement).textContent = name;
  document.title = `${name} · Groma`;
  const height = accuracy.parts.find((part) => part.name === "height");
  const facts = byId("facts", HTMLDListElement);
  facts.replaceChildren(
    ...fact("Points", { text: countWords(pointCount) }),
    ...fact("Coordinate system", crsWords(crs, { given: basis === "given" })),
    ...fact("Height", heightWords(crs, { applied: height !== undefined && height.metres !== null })),
    ...fact("Accuracy", accuracyWords(accuracy), partsOf(accuracy.parts)),
  );
  facts.hidden = false;
}

function fact(term: string, { text, note }: Words, more?: HTMLElement): HTMLElement[] {
  const value = textElement("dd", text);
  if (note) value.append(textElement("small", note));
  if (more) value.append(more);
  return [textElement("dt", term), value];
}

/** The parts of an accuracy, folded away. */
function partsOf(parts: readonly AccuracyPart[]): HTMLElement {
  const details = document.createElement("details");
  details.className = "parts";
  const list = document.createElement("ul");
  for (const { name, metres, note } of parts) {
    const item = document.createElement("li");
    item.append(textElement("span", name), textElement("span", lengthWords(metres)));
    if (note) item.append(textElement("small", note));
    list.append(item);
  }
  details.append(textElement("summary", `${parts.length} parts`), list);
  return details;
}

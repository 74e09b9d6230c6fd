import type { PointCloudLayer } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { libraryWords } from "../language/library-words.js";
import { byId, textElement } from "./elements.js";
import { countWords } from "./words.js";

/** The classes that a cloud has: their colours, and which are shown. */
export class Classes {
  readonly #place = byId("classes", HTMLDetailsElement);
  readonly #list = byId("class-list", HTMLUListElement);

  attach(layer: PointCloudLayer): void {
    const counts = layer.cloud.statistics?.classes ?? {};
    // A damaged record may count what is no class.
    const numbers = Object.keys(counts)
      .map(Number)
      .filter((number) => layer.style.classes[number] !== undefined);
    this.#list.replaceChildren(...numbers.map((number) => rowOf(layer, number, counts[number] ?? 0)));
    this.#place.hidden = numbers.length === 0;
  }
}

function rowOf(layer: PointCloudLayer, number: number, count: number): HTMLElement {
  const { name: given, color, show } = layer.style.classes[number]!;
  const name = libraryWords(given);
  const shown = document.createElement("input");
  shown.type = "checkbox";
  shown.checked = show;
  shown.addEventListener("change", () => {
    layer.style = { classes: { [number]: { show: shown.checked } } };
  });
  const tint = document.createElement("input");
  tint.type = "color";
  tint.value = hexOf(color);
  tint.setAttribute("aria-label", i18n.t("Colour of {name}", { name }));
  tint.addEventListener("input", () => {
    layer.style = { classes: { [number]: { color: colourOf(tint.value) } } };
  });
  const label = document.createElement("label");
  label.className = "check";
  label.append(shown, textElement("span", `${number} ${name}`), textElement("small", countWords(count)));
  const row = document.createElement("li");
  row.append(tint, label);
  return row;
}

/** `#rrggbb` of sRGB from 0 to 1. */
function hexOf(color: readonly number[]): string {
  return `#${color
    .map((part) =>
      Math.round(255 * part)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

function colourOf(hex: string): [number, number, number] {
  const part = (at: number) => Number.parseInt(hex.slice(at, at + 2), 16) / 255;
  return [part(1), part(3), part(5)];
}

import type { LedgerRow, PointCloudLayer } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { byId, setText, textElement } from "./elements.js";
import { costWords, effectWords, frameWords, magnitudeWords, stateWords } from "./ledger-words.js";

/** Milliseconds between two writings: quick enough to be live, slow enough to be read. */
const INTERVAL = 500;

/** Frames that costs are measured in after a change. */
const MEASURED = 30;

/** The effects of a layer, what each would change and what it costs, live while it is open. */
export class Ledger {
  readonly #place = byId("ledger", HTMLDetailsElement);
  readonly #rows = byId("ledger-rows", HTMLTableSectionElement);
  readonly #frame = byId("ledger-frame", HTMLParagraphElement);
  readonly #instead: () => readonly LedgerRow[] | undefined;
  #layer: PointCloudLayer | undefined;

  /** @param instead the rows of a view that stands in the place of the globe, if one does */
  constructor(instead: () => readonly LedgerRow[] | undefined) {
    this.#instead = instead;
    setInterval(() => this.#write(), INTERVAL);
    this.#place.addEventListener("toggle", () => this.#write());
  }

  /** Further rows, beside those of the layer; asked for whenever they are written. */
  further: () => readonly LedgerRow[] = () => [];

  /** How many frames of a change it wants to see: costs are means of frames that follow each other. */
  get frames(): number {
    return this.#place.open ? MEASURED : 1;
  }

  attach(layer: PointCloudLayer): void {
    this.#layer = layer;
    this.#place.hidden = false;
    this.#write();
  }

  #write(): void {
    const layer = this.#layer;
    if (!this.#place.open || !layer || layer.isDestroyed() || document.hidden) return;
    this.#rows.replaceChildren(...[...(this.#instead() ?? layer.ledger), ...this.further()].map(rowOf));
    setText(this.#frame, frameWords(layer.statistics.gpuMilliseconds));
  }
}

function rowOf(row: LedgerRow): HTMLTableRowElement {
  const element = document.createElement("tr");
  element.className = row.active ? "active" : "";
  // The library's own words, English as they are.
  element.title = `${row.why}. ${row.source}`;
  element.lang = "en";
  const name = textElement("th", effectWords(row));
  name.scope = "row";
  const cells = [magnitudeWords(row), stateWords(row), costWords(row.cost)];
  element.append(name, ...cells.map((words) => textElement("td", words)));
  for (const cell of Array.from(element.cells)) cell.lang = i18n.locale;
  return element;
}

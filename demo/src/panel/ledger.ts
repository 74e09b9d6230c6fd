import type { LedgerRow, PointCloudLayer } from "@groma/layer/cesium";
import { byId, setText, textElement } from "./elements.js";
import { costWords, effectWords, frameWords, magnitudeWords, stateWords } from "./ledger-words.js";

/** Milliseconds between two writings: quick enough to be live, slow enough to be read. */
const INTERVAL = 500;

/** The effects of a layer, what each would change and what it costs, live while it is open. */
export class Ledger {
  readonly #place = byId("ledger", HTMLDetailsElement);
  readonly #rows = byId("ledger-rows", HTMLTableSectionElement);
  readonly #frame = byId("ledger-frame", HTMLParagraphElement);
  #layer: PointCloudLayer | undefined;

  constructor() {
    setInterval(() => this.#write(), INTERVAL);
    this.#place.addEventListener("toggle", () => this.#write());
  }

  /** Further rows, beside those of the layer; asked for whenever they are written. */
  further: () => readonly LedgerRow[] = () => [];

  attach(layer: PointCloudLayer): void {
    this.#layer = layer;
    this.#place.hidden = false;
    this.#write();
  }

  #write(): void {
    const layer = this.#layer;
    if (!this.#place.open || !layer || layer.isDestroyed() || document.hidden) return;
    this.#rows.replaceChildren(...[...layer.ledger, ...this.further()].map(rowOf));
    setText(this.#frame, frameWords(layer.statistics.gpuMilliseconds));
  }
}

function rowOf(row: LedgerRow): HTMLTableRowElement {
  const element = document.createElement("tr");
  element.className = row.active ? "active" : "";
  element.title = `${row.why}. ${row.source}`;
  const name = textElement("th", effectWords(row));
  name.scope = "row";
  element.append(
    name,
    textElement("td", magnitudeWords(row)),
    textElement("td", stateWords(row)),
    textElement("td", costWords(row.cost)),
  );
  return element;
}

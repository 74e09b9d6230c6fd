import { DecodeError, FormatError, type PointCloudLayer, SourceError } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import type { Message } from "./message.js";

/** Tells of nodes that cannot be had, on the globe and on the map, and lets the reader have all of them asked for again. */
export class Failures {
  readonly #message: Message;
  readonly #retry: () => void;
  /** Layers whose first failure was told: how many nodes fail is told with the progress. */
  readonly #told = new Set<PointCloudLayer>();

  /** @param retry has what failed asked for again, wherever it is drawn */
  constructor(message: Message, retry: () => void) {
    this.#message = message;
    this.#retry = retry;
  }

  /** Tells the first node of a layer on the globe that fails. */
  watch(layer: PointCloudLayer): void {
    layer.nodeFailed.addEventListener((_node, thrown) => {
      if (this.#told.has(layer)) return;
      this.#told.add(layer);
      this.#tell(thrown);
    });
  }

  /** Tells what the map cannot draw. Its layers tell each failure once. */
  ofMap(thrown: unknown): void {
    const ofNode = [SourceError, FormatError, DecodeError].some((kind) => thrown instanceof kind);
    if (ofNode) this.#tell(thrown);
    else this.#message.show(thrown);
  }

  #tell(thrown: unknown): void {
    const run = () => {
      this.#told.clear();
      this.#retry();
    };
    this.#message.show(thrown, { label: i18n.t("Try again"), run });
  }
}

/** Tells what nobody caught: it is the page's fault, and the reader should not have to look into the console for it. */
export function tellUncaught(message: Message): void {
  // Without an error it is a remark of the browser's, on observers of sizes say.
  addEventListener("error", ({ error }) => error && message.show(error));
  addEventListener("unhandledrejection", ({ reason }) => message.show(reason));
}

import type { PointCloudLayer } from "@groma/layer/cesium";
import type { Aspect } from "../scene/camera.js";
import { byId, setText } from "./elements.js";
import { liftWords } from "./words.js";

/** The switches for how high a cloud is drawn, and from where it is seen. */
export class Controls {
  readonly #lift = byId("lift", HTMLInputElement);
  readonly #liftNote = byId("lift-note", HTMLParagraphElement);
  #layer: PointCloudLayer | undefined;

  /** @param look called when the reader wants to see the whole cloud */
  constructor(look: (aspect: Aspect) => void) {
    byId("controls", HTMLFormElement).addEventListener("submit", (event) => event.preventDefault());
    this.#lift.addEventListener("input", () => this.#apply());
    byId("fit", HTMLButtonElement).addEventListener("click", () => look("oblique"));
    byId("above", HTMLButtonElement).addEventListener("click", () => look("above"));
  }

  /** Shows how a layer is drawn, and changes that from now on. */
  attach(layer: PointCloudLayer): void {
    this.#layer = layer;
    this.#lift.value = String(layer.heightOffset);
    this.#writeLift(layer);
  }

  #apply(): void {
    const layer = this.#layer;
    if (!layer || layer.isDestroyed()) return;
    // Half a number, as while it is being typed, changes nothing yet.
    if (this.#lift.validity.valid && this.#lift.value !== "") layer.heightOffset = this.#lift.valueAsNumber;
    this.#writeLift(layer);
  }

  #writeLift({ heightOffset }: PointCloudLayer): void {
    setText(this.#liftNote, liftWords(heightOffset));
  }
}

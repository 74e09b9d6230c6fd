import type { ColourBy, PointCloudLayer } from "@groma/layer/cesium";
import { COLOURS } from "../address.js";
import type { Aspect } from "../camera.js";
import { byId } from "./elements.js";
import { liftWords } from "./words.js";

/** The switches for how a cloud is drawn and from where it is seen. */
export class Controls {
  readonly #form = byId("controls", HTMLFormElement);
  readonly #size = byId("size", HTMLInputElement);
  readonly #sizeValue = byId("size-value", HTMLOutputElement);
  readonly #lift = byId("lift", HTMLInputElement);
  readonly #liftNote = byId("lift-note", HTMLParagraphElement);
  readonly #show = byId("show", HTMLInputElement);
  readonly #colours: readonly HTMLInputElement[];
  #layer: PointCloudLayer | undefined;

  /** @param look called when the reader wants to see the whole cloud */
  constructor(look: (aspect: Aspect) => void) {
    this.#colours = [...this.#form.querySelectorAll<HTMLInputElement>("input[name=color]")];
    this.#form.addEventListener("submit", (event) => event.preventDefault());
    this.#form.addEventListener("input", () => this.#apply());
    byId("fit", HTMLButtonElement).addEventListener("click", () => look("oblique"));
    byId("above", HTMLButtonElement).addEventListener("click", () => look("above"));
  }

  /** Shows how a layer is drawn, and changes that from now on. */
  attach(layer: PointCloudLayer): void {
    this.#layer = layer;
    const { color, pointSize } = layer.style;
    for (const input of this.#colours) {
      input.checked = input.value === color;
      input.disabled = input.value === "rgb" && !layer.cloud.hasColour;
    }
    this.#size.max = String(Math.max(10, pointSize));
    this.#size.value = String(pointSize);
    this.#lift.value = String(layer.heightOffset);
    this.#show.checked = layer.show;
    this.#writeSize();
    this.#writeLift(layer);
    this.#form.hidden = false;
  }

  #apply(): void {
    const layer = this.#layer;
    if (!layer || layer.isDestroyed()) return;
    const chosen = this.#colours.find((input) => input.checked)?.value;
    const color: ColourBy = COLOURS.find((each) => each === chosen) ?? layer.style.color;
    layer.style = { color, pointSize: this.#size.valueAsNumber };
    // Half a number, as while it is being typed, changes nothing yet.
    if (this.#lift.validity.valid && this.#lift.value !== "") layer.heightOffset = this.#lift.valueAsNumber;
    layer.show = this.#show.checked;
    this.#writeSize();
    this.#writeLift(layer);
  }

  #writeLift({ heightOffset }: PointCloudLayer): void {
    this.#liftNote.textContent = liftWords(heightOffset);
  }

  #writeSize(): void {
    this.#sizeValue.value = `${this.#size.value} px`;
  }
}

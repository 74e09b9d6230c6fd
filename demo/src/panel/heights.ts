import type { PointCloud } from "@groma/layer/cesium";
import { chooseHeight, type HeightWish } from "../height-choice.js";
import { byId } from "./elements.js";

/** The switch for what heights are measured from. */
export class Heights {
  readonly #form = byId("heights", HTMLFormElement);
  readonly #wish = byId("height", HTMLSelectElement);
  readonly #codeField = byId("height-code-field", HTMLLabelElement);
  readonly #code = byId("height-code", HTMLInputElement);
  readonly #note = byId("height-note", HTMLParagraphElement);
  #cloud: PointCloud | undefined;
  /** Height reference that the cloud was opened with in place of its own. */
  #vertical: string | undefined;

  /** @param reopen opens the cloud with another height reference, or its own; resolves to whether that was possible */
  constructor(reopen: (vertical: string | undefined) => Promise<boolean>) {
    const apply = async () => {
      if (!this.#cloud) return;
      const wish = this.#wish.value as HeightWish;
      this.#codeField.hidden = wish !== "code";
      const choice = chooseHeight(wish, this.#code.value, this.#cloud.name);
      this.#note.textContent = choice.kind === "refused" ? choice.words : "";
      if (choice.kind === "refused" || choice.vertical === this.#vertical) return;
      if (!(await reopen(choice.vertical))) this.#write();
    };
    this.#form.addEventListener("submit", (event) => event.preventDefault());
    this.#form.addEventListener("change", () => void apply());
  }

  /** Shows what a cloud's heights are measured from, and lets the reader change that. */
  attach(cloud: PointCloud, vertical: string | undefined): void {
    this.#cloud = cloud;
    this.#vertical = vertical;
    this.#write();
    // What was placed as a body has no heights of its own.
    this.#form.hidden = cloud.engine.name === "similarity";
  }

  #write(): void {
    const known = this.#vertical?.toLowerCase() === "ellipsoidal";
    this.#wish.value = known ? "ellipsoidal" : this.#vertical === undefined ? "declared" : "code";
    this.#code.value = known ? "" : (this.#vertical ?? "");
    this.#codeField.hidden = this.#wish.value !== "code";
    this.#note.textContent = "";
  }
}

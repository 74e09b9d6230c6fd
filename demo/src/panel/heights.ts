import type { HeightGuess } from "@groma/georef";
import { guessHeights, type PointCloud } from "@groma/layer/cesium";
import { i18n } from "../language/i18n.js";
import { chooseHeight, type HeightWish } from "../scene/height-choice.js";
import { byId, optionElement, setText, textElement } from "./elements.js";

/** The switch for what heights are measured from, with what they may be where nobody has said it. */
export class Heights {
  readonly #form = byId("heights", HTMLFormElement);
  readonly #wish = byId("height", HTMLSelectElement);
  readonly #codeField = byId("height-code-field", HTMLLabelElement);
  readonly #code = byId("height-code", HTMLInputElement);
  readonly #note = byId("height-note", HTMLParagraphElement);
  readonly #likely = document.createElement("datalist");
  #cloud: PointCloud | undefined;
  /** Height reference that the cloud was opened with in place of its own. */
  #vertical: string | undefined;
  /** Of the cloud at hand, once it was asked for. */
  #guess: Promise<HeightGuess | undefined> | undefined;

  /** @param reopen opens the cloud with another height reference, or its own; resolves to whether that was possible */
  constructor(reopen: (vertical: string | undefined) => Promise<boolean>) {
    this.#likely.id = "height-systems";
    this.#code.after(this.#likely);
    this.#code.setAttribute("list", this.#likely.id);
    const apply = async () => {
      if (!this.#cloud) return;
      const wish = this.#wish.value as HeightWish;
      this.#codeField.hidden = wish !== "code";
      if (wish === "code") void this.#offer();
      const choice = chooseHeight(wish, this.#code.value);
      setText(this.#note, choice.kind === "refused" ? choice.words : "");
      if (choice.kind === "refused" || choice.vertical === this.#vertical) return;
      if (!(await reopen(choice.vertical))) this.#write();
    };
    this.#form.addEventListener("submit", (event) => event.preventDefault());
    this.#form.addEventListener("change", () => void apply());
    this.#form.addEventListener("click", ({ target }) => {
      if (!(target instanceof HTMLButtonElement) || target.value === "") return;
      this.#wish.value = "code" satisfies HeightWish;
      this.#code.value = target.value;
      void apply();
    });
  }

  /** Shows what a cloud's heights are measured from, and lets the reader change that. */
  attach(cloud: PointCloud, vertical: string | undefined): void {
    if (cloud.name !== this.#cloud?.name) this.#likely.replaceChildren();
    this.#cloud = cloud;
    this.#vertical = vertical;
    this.#guess = undefined;
    this.#write();
    // What was placed as a body has no heights of its own.
    this.#form.hidden = cloud.engine.name === "similarity";
    if (cloud.height.kind === "unknown" && !this.#form.hidden) void this.#offer();
  }

  #write(): void {
    const known = this.#vertical?.toLowerCase() === "ellipsoidal";
    this.#wish.value = known ? "ellipsoidal" : this.#vertical === undefined ? "declared" : "code";
    this.#code.value = known ? "" : (this.#vertical ?? "");
    this.#codeField.hidden = this.#wish.value !== "code";
    setText(this.#note, "");
  }

  /** Offers the height systems in use where the cloud lies; of an unknown one it says what is at stake. */
  async #offer(): Promise<void> {
    const cloud = this.#cloud;
    if (!cloud) return;
    // Without the data for a guess there is nothing to offer, and nothing that the reader lacks.
    this.#guess ??= guessHeights(cloud).catch(() => undefined);
    const guess = await this.#guess;
    if (!guess || this.#cloud !== cloud) return;
    this.#likely.replaceChildren(
      ...guess.systems.map(({ code, name }) => optionElement({ value: `EPSG:${code}`, label: name })),
    );
    if (cloud.height.kind !== "unknown" || this.#wish.value !== "declared") return;
    setText(this.#note, i18n.t("Not declared by the file: {note}.", { note: guess.note }));
    const [first] = guess.systems;
    if (!first) return;
    const take = textElement("button", i18n.t("Take {name}", { name: first.name }));
    take.type = "button";
    take.value = `EPSG:${first.code}`;
    this.#note.append(" ", take);
  }
}

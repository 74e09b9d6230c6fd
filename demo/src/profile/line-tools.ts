import { i18n } from "../language/i18n.js";
import { byId, optionElement } from "../panel/elements.js";
import type { ProfileLines } from "./profile-lines.js";

/** The controls of the lines themselves: which one is shown, its name, direction, width and start, files of lines, undo and redo. */
export class LineTools {
  readonly #lines: ProfileLines;
  readonly #list = byId("profile-list", HTMLSelectElement);
  readonly #name = byId("profile-name", HTMLInputElement);
  readonly #reverse = byId("profile-reverse", HTMLButtonElement);
  readonly #remove = byId("profile-remove", HTMLButtonElement);
  readonly #undo = byId("profile-undo", HTMLButtonElement);
  readonly #redo = byId("profile-redo", HTMLButtonElement);
  readonly #from = byId("profile-from", HTMLInputElement);
  readonly #width = byId("profile-width", HTMLInputElement);
  readonly #anew: () => void;
  /** Of the strip, metres: the last one that was valid. */
  #valid = this.#width.valueAsNumber;
  /** Id of the line whose settings the fields have. */
  #shown: string | undefined;

  /** @param anew hears of another width, and of another chainage at the start */
  constructor(lines: ProfileLines, anew: () => void, failed: (thrown: unknown) => void) {
    this.#lines = lines;
    this.#anew = anew;
    this.#list.addEventListener("change", () => lines.choose(this.#list.value || undefined));
    this.#name.addEventListener("change", () => lines.rename(this.#name.value.trim() || i18n.t("profile")));
    this.#reverse.addEventListener("click", () => lines.reverse());
    this.#remove.addEventListener("click", () => lines.remove());
    this.#undo.addEventListener("click", () => lines.tool.undo());
    this.#redo.addEventListener("click", () => lines.tool.redo());
    this.#from.addEventListener("change", () => this.#settle());
    this.#width.addEventListener("change", () => {
      // A width that is none is told at the field, in the browser's words.
      if (this.#width.reportValidity()) this.width = this.#width.valueAsNumber;
    });
    const file = byId("profile-file", HTMLInputElement);
    file.addEventListener("change", () => {
      const [chosen] = file.files ?? [];
      file.value = "";
      if (chosen) this.#open(chosen).catch(failed);
    });
  }

  /** Chainage at the start of the line, metres. */
  get start(): number {
    const { valueAsNumber } = this.#from;
    return Number.isFinite(valueAsNumber) ? valueAsNumber : 0;
  }

  /** Of the strip, metres. */
  get width(): number {
    return this.#valid;
  }

  set width(width: number) {
    this.#showWidth(width);
    this.#settle();
  }

  /** Shows what there is. */
  show(): void {
    const { all, chosen, tool } = this.#lines;
    this.#showSettings();
    this.#list.replaceChildren(
      optionElement({ value: "", label: i18n.t("profiles…") }),
      ...all.map(({ id, name }) => optionElement({ value: id, label: name })),
    );
    this.#list.hidden = all.length === 0;
    this.#list.value = chosen?.id ?? "";
    this.#name.value = chosen?.name ?? "";
    for (const field of [this.#name, this.#reverse, this.#remove]) field.disabled = chosen === undefined;
    this.#undo.disabled = !tool.canUndo;
    this.#redo.disabled = !tool.canRedo;
  }

  /** Each line has a width and a start of its own; a new one has the width of the one before. */
  #showSettings(): void {
    const { chosen, settings } = this.#lines;
    if (chosen?.id === this.#shown) return;
    this.#shown = chosen?.id;
    if (settings) this.#showWidth(settings.width);
    if (settings || !chosen) this.#from.value = String(settings?.start ?? 0);
    else this.#keep();
  }

  #showWidth(width: number): void {
    this.#valid = width;
    this.#width.value = String(width);
  }

  #settle(): void {
    this.#keep();
    this.#anew();
  }

  #keep(): void {
    this.#lines.settle({ width: this.width, start: this.start });
  }

  async #open(file: File): Promise<void> {
    await this.#lines.open(file, this.width);
  }
}

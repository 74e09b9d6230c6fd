import { i18n } from "../language/i18n.js";
import { byId, optionElement } from "../panel/elements.js";
import type { ProfileLines } from "./profile-lines.js";

/** The controls of the lines themselves: which one is shown, its name and direction, files of lines, undo and redo. */
export class LineTools {
  readonly #lines: ProfileLines;
  readonly #list = byId("profile-list", HTMLSelectElement);
  readonly #name = byId("profile-name", HTMLInputElement);
  readonly #reverse = byId("profile-reverse", HTMLButtonElement);
  readonly #remove = byId("profile-remove", HTMLButtonElement);
  readonly #undo = byId("profile-undo", HTMLButtonElement);
  readonly #redo = byId("profile-redo", HTMLButtonElement);
  readonly #from = byId("profile-from", HTMLInputElement);

  /** @param restart hears of another chainage at the start */
  constructor(lines: ProfileLines, restart: () => void, failed: (thrown: unknown) => void) {
    this.#lines = lines;
    this.#list.addEventListener("change", () => lines.choose(this.#list.value || undefined));
    this.#name.addEventListener("change", () => lines.rename(this.#name.value.trim() || i18n.t("profile")));
    this.#reverse.addEventListener("click", () => lines.reverse());
    this.#remove.addEventListener("click", () => lines.remove());
    this.#undo.addEventListener("click", () => lines.tool.undo());
    this.#redo.addEventListener("click", () => lines.tool.redo());
    this.#from.addEventListener("change", restart);
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

  /** Shows what there is. */
  show(): void {
    const { all, chosen, tool } = this.#lines;
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

  async #open(file: File): Promise<void> {
    await this.#lines.open(file, (start) => {
      this.#from.value = String(start);
    });
  }
}

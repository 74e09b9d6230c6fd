import { MEASUREMENT_KINDS, type MeasurementKind } from "../measure/index.js";
import type { MeasureTool } from "./measure-tool.js";
import type { MeasureWords } from "./words.js";

/** How a tool bar looks. */
export interface MeasureControlOptions {
  /** Which buttons there are, in their order. Default: one for each kind. */
  readonly kinds?: readonly MeasurementKind[] | undefined;
  /** What it says, where that is not what the tool's `words` have. */
  readonly words?: Partial<Pick<MeasureWords, "measure" | "undo" | "redo" | "kind">> | undefined;
}

/**
 * A tool bar for a `MeasureTool`: a button for each kind of measurement, undo and redo. Its `element` goes wherever the
 * application wants it, `map.addControl(new Control({ element }))` and `viewer.container.append(element)` among it. It is
 * of the class `groma-control`; the button of what is being drawn is `aria-pressed`.
 */
export class MeasureControl {
  readonly element = document.createElement("div");
  readonly #tool: MeasureTool;
  readonly #kinds = new Map<MeasurementKind, HTMLButtonElement>();
  readonly #undo: HTMLButtonElement;
  readonly #redo: HTMLButtonElement;
  readonly #unwatch: () => void;

  constructor(tool: MeasureTool, { kinds, words: own }: MeasureControlOptions = {}) {
    const words = { ...tool.words, ...own };
    this.#tool = tool;
    [this.#undo, this.#redo] = [button(words.undo), button(words.redo)];
    this.element.className = "groma-control";
    this.element.setAttribute("role", "toolbar");
    this.element.setAttribute("aria-label", words.measure);
    for (const kind of kinds ?? (Object.keys(MEASUREMENT_KINDS) as MeasurementKind[])) {
      const made = button(words.kind(kind));
      made.addEventListener("click", () => {
        if (tool.drawing === kind) tool.cancel();
        else void tool.draw(kind);
      });
      this.#kinds.set(kind, made);
    }
    this.#undo.addEventListener("click", () => tool.undo());
    this.#redo.addEventListener("click", () => tool.redo());
    this.element.append(...this.#kinds.values(), this.#undo, this.#redo);
    this.#unwatch = tool.onChange(() => this.#show());
    this.#show();
  }

  /** Takes it off the page; the tool stays. */
  destroy(): void {
    this.#unwatch();
    this.element.remove();
  }

  #show(): void {
    const { drawing, canUndo, canRedo } = this.#tool;
    for (const [kind, made] of this.#kinds) made.setAttribute("aria-pressed", String(kind === drawing));
    this.#undo.disabled = !canUndo;
    this.#redo.disabled = !canRedo;
  }
}

function button(text: string): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.textContent = text;
  return made;
}

import { byId, setText } from "./elements.js";
import { foldIfNarrow } from "./fold.js";

/** What the reader is to do while something is drawn on globe or map, and the way out for who has no keys. */
export class DrawingHint {
  readonly #words = byId("drawing-words", HTMLParagraphElement);
  readonly #end = byId("drawing-end", HTMLButtonElement);

  /** @param end ends what is drawn */
  constructor(end: () => void) {
    this.#end.addEventListener("click", end);
  }

  /** @param words empty: nothing is drawn */
  show(words: string): void {
    // On a phone the panel lies over all that could be touched.
    if (this.#end.hidden && words !== "") foldIfNarrow();
    this.#end.hidden = words === "";
    setText(this.#words, words);
  }
}

import type { Context } from "./cesium-private.js";

/** Tells when the browser takes the context away that a layer draws in, even where it comes back before the next frame. */
export class ContextWatch {
  readonly #lost: () => void;
  #canvas: EventTarget | undefined;
  #losses = 0;

  /** @param lost called while the context is lost, when freeing its objects does nothing and harms nothing */
  constructor(lost: () => void) {
    this.#lost = lost;
  }

  /** How often a context was lost. */
  get losses(): number {
    return this.#losses;
  }

  /** Watches this context from now on, and no other. */
  follow({ _gl: { canvas } }: Context): void {
    if (canvas === this.#canvas) return;
    this.destroy();
    this.#canvas = canvas;
    canvas.addEventListener("webglcontextlost", this.#onLost);
  }

  destroy(): void {
    this.#canvas?.removeEventListener("webglcontextlost", this.#onLost);
    this.#canvas = undefined;
  }

  readonly #onLost = (): void => {
    this.#losses++;
    this.#lost();
  };
}

import { contextOf } from "../webgl2/context.js";
import { clear } from "../webgl2/point-passes.js";

/** The element that a layer puts into a map: a canvas with a WebGL 2 context of its own. */
export class MapCanvas {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  #gl: WebGL2RenderingContext | undefined;
  readonly #events: { readonly lost: () => void; readonly restored: () => void };

  /** @param events of the context: it is taken away, and comes back */
  constructor(className: string, events: { readonly lost: () => void; readonly restored: () => void }) {
    this.element = document.createElement("div");
    this.element.className = className;
    Object.assign(this.element.style, { position: "absolute", width: "100%", height: "100%" });
    this.canvas = document.createElement("canvas");
    Object.assign(this.canvas.style, { position: "absolute", left: "0" });
    this.element.append(this.canvas);
    this.#events = events;
    this.canvas.addEventListener("webglcontextlost", this.#onLost);
    this.canvas.addEventListener("webglcontextrestored", this.#onRestored);
  }

  /**
   * The context; undefined while the browser has taken it away.
   * @throws DrawError DRAW_WEBGL2 where the browser has no WebGL 2
   */
  get gl(): WebGL2RenderingContext | undefined {
    this.#gl ??= contextOf(this.canvas, "map");
    return this.#gl.isContextLost() ? undefined : this.#gl;
  }

  /** @param size CSS pixels */
  lay(size: readonly number[], opacity: number): void {
    const { style } = this.canvas;
    style.width = `${size[0]}px`;
    style.height = `${size[1]}px`;
    style.opacity = opacity === 1 ? "" : String(opacity);
  }

  /** Leaves nothing on it. */
  wipe(): void {
    const { gl } = this;
    if (!gl) return;
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    clear(gl, { framebuffer: undefined, viewport: [0, 0, width, height] });
  }

  destroy(): void {
    this.canvas.removeEventListener("webglcontextlost", this.#onLost);
    this.canvas.removeEventListener("webglcontextrestored", this.#onRestored);
    // Browsers count contexts, and take away the oldest when there are some sixteen.
    this.#gl?.getExtension("WEBGL_lose_context")?.loseContext();
    this.element.remove();
  }

  readonly #onLost = (event: Event): void => {
    // Else the browser would not give it back.
    event.preventDefault();
    this.#events.lost();
  };

  readonly #onRestored = (): void => this.#events.restored();
}

import type { Vector } from "@groma/georef";
import type Feature from "ol/Feature.js";
import { type DrawnKind, GlobeDrawing } from "./globe-drawing.js";
import type { GlobeSide } from "./globe-side.js";
import type { SharedFeatures, SharedVertex } from "./shared-features.js";

/** CSS pixels that a pointer goes before a side that it holds has a new vertex. */
const JITTER = 3;

/**
 * Has shared features drawn on the globe, and changed there as by `Modify` on the map: vertices are dragged, a side that is
 * dragged has a new one, and Alt with a click takes one away.
 */
export class GlobeEditing {
  readonly #globe: GlobeSide;
  readonly #features: SharedFeatures;
  readonly #failed: (thrown: unknown) => void;
  readonly #end = new AbortController();
  #held: SharedVertex | undefined;
  /** A side that is held, and where it was taken hold of. */
  #side: { readonly side: SharedVertex; readonly x: number; readonly y: number } | undefined;
  /** Features that are being drawn. */
  #drawing = 0;
  /** Where the pointer was last, until it is worked through. */
  #next: { readonly x: number; readonly y: number } | undefined;
  #busy = false;

  /** Whether the reader draws or changes a feature now. */
  get busy(): boolean {
    return this.#drawing > 0 || this.#held !== undefined || this.#side !== undefined;
  }

  /** @param failed called with what kept a record from being read */
  constructor(globe: GlobeSide, features: SharedFeatures, failed: (thrown: unknown) => void) {
    this.#globe = globe;
    this.#features = features;
    this.#failed = failed;
    const { canvas, screenSpaceCameraController: camera } = globe.scene;
    const { signal } = this.#end;
    canvas.addEventListener(
      "pointerdown",
      ({ offsetX: x, offsetY: y, button, altKey, pointerId }) => {
        if (button !== 0 || altKey) return;
        this.#held = features.vertexAt({ x, y });
        const side = this.#held || this.#drawing > 0 ? undefined : features.sideAt({ x, y });
        this.#side = side && { side, x, y };
        if (!this.#held && !side) return;
        // The drag is the vertex's, not the camera's.
        camera.enableInputs = false;
        canvas.setPointerCapture(pointerId);
      },
      { signal },
    );
    canvas.addEventListener(
      "pointermove",
      ({ offsetX: x, offsetY: y }) => {
        if (!this.#held && !this.#side) return;
        if (this.#side && Math.hypot(x - this.#side.x, y - this.#side.y) <= JITTER) return;
        this.#next = { x, y };
        if (!this.#busy) void this.#move();
      },
      { signal },
    );
    canvas.addEventListener(
      "click",
      ({ offsetX: x, offsetY: y, altKey }) => {
        const vertex = altKey ? features.vertexAt({ x, y }) : undefined;
        if (vertex) features.remove(vertex);
      },
      { signal },
    );
    for (const event of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(
        event,
        () => {
          if (!this.#held && !this.#side) return;
          camera.enableInputs = true;
          if (!this.#busy) this.#release();
        },
        { signal },
      );
    }
  }

  /**
   * Has the reader draw a feature, see {@link GlobeDrawing}.
   * @returns undefined where the reader gives it up
   * @throws the signal's reason when aborted
   */
  async draw(kind: DrawnKind, signal?: AbortSignal): Promise<Feature | undefined> {
    signal?.throwIfAborted();
    const [globe, features] = [this.#globe, this.#features];
    this.#drawing++;
    const ended = () => {
      this.#drawing--;
      this.#end.signal.removeEventListener("abort", giveUp);
    };
    const drawing = new GlobeDrawing({ globe, features, failed: this.#failed, ended }, kind, signal);
    const giveUp = () => drawing.giveUp();
    this.#end.signal.addEventListener("abort", giveUp);
    return drawing.done;
  }

  dispose(): void {
    const { scene } = this.#globe;
    if ((this.#held || this.#side) && !scene.isDestroyed())
      scene.screenSpaceCameraController.enableInputs = true;
    this.#end.abort();
  }

  async #move(): Promise<void> {
    const { signal } = this.#end;
    this.#busy = true;
    for (let at = this.#next; at && (this.#held || this.#side); at = this.#next) {
      this.#next = undefined;
      try {
        const place = await this.#globe.placeAt(at, signal);
        if (place && !signal.aborted) this.#put(place);
      } catch (thrown) {
        if (!signal.aborted) this.#failed(thrown);
      }
    }
    this.#busy = false;
    if (this.#globe.scene.screenSpaceCameraController.enableInputs) this.#release();
  }

  /** Puts what is held at a place; a side has a vertex there from then on. */
  #put(place: Vector): void {
    if (this.#held) this.#features.move(this.#held, place);
    else if (this.#side) this.#held = this.#features.insert(this.#side.side, place);
    if (this.#held) this.#side = undefined;
  }

  #release(): void {
    this.#held = undefined;
    this.#side = undefined;
  }
}

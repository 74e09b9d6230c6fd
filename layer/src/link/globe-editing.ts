import type { Vector } from "@groma/georef";
import { ScreenSpaceEventHandler, ScreenSpaceEventType } from "cesium";
import Feature from "ol/Feature.js";
import LineString from "ol/geom/LineString.js";
import Point from "ol/geom/Point.js";
import Polygon from "ol/geom/Polygon.js";
import type { GlobeSide } from "./globe-side.js";
import type { SharedFeatures, SharedVertex } from "./shared-features.js";

/** What can be drawn on the globe. */
export type DrawnKind = "Point" | "LineString" | "Polygon";

/** Vertices that a kind needs before it can be ended, and at most. */
const COUNTS: Readonly<Record<DrawnKind, { readonly least: number; readonly most: number }>> = {
  Point: { least: 1, most: 1 },
  LineString: { least: 2, most: Number.POSITIVE_INFINITY },
  Polygon: { least: 3, most: Number.POSITIVE_INFINITY },
};

/** CSS pixels that a pointer goes before a side that it holds has a new vertex. */
const JITTER = 3;

/**
 * Draws shared features on the globe and changes them there, as `Modify` does on the map: vertices are dragged, a side that
 * is dragged has a new one, and Alt with a click takes one away.
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
   * Has the reader draw a feature by clicks on the globe; it is in the source from its first vertex on. A double click or
   * Enter ends it, Escape gives it up.
   * @returns undefined where the reader gives it up
   * @throws the signal's reason when aborted
   */
  async draw(kind: DrawnKind, signal?: AbortSignal): Promise<Feature | undefined> {
    signal?.throwIfAborted();
    const { scene } = this.#globe;
    const { source } = this.#features;
    const feature = new Feature();
    const places: Vector[] = [];
    const handler = new ScreenSpaceEventHandler(scene.canvas);
    const keys = new AbortController();
    // Clicks keep their order, however long their records take.
    let last: Promise<void> = Promise.resolve();
    this.#drawing++;
    return new Promise((resolve, reject) => {
      const end = (drawn: Feature | undefined) => {
        if (keys.signal.aborted) return;
        this.#drawing--;
        handler.destroy();
        keys.abort();
        if (!drawn && source.hasFeature(feature)) source.removeFeature(feature);
        resolve(drawn);
      };
      const finish = () => {
        if (places.length >= COUNTS[kind].least) end(feature);
      };
      const place = async (at: { readonly x: number; readonly y: number }) => {
        const found = await this.#globe.placeAt(at, AbortSignal.any([keys.signal, this.#end.signal]));
        // The second click of a double click is on the record of the first.
        if (!found || keys.signal.aborted || `${found}` === `${places.at(-1)}`) return;
        places.push(found);
        const coordinates = places.flatMap((one) => [this.#features.coordinateOf(feature, one) ?? []]);
        feature.setGeometry(geometryOf(kind, coordinates));
        if (!source.hasFeature(feature)) source.addFeature(feature);
        if (places.length >= COUNTS[kind].most) finish();
      };
      handler.setInputAction(({ position: { x, y } }: ScreenSpaceEventHandler.PositionedEvent) => {
        last = last
          .then(() => place({ x, y }))
          .catch((thrown) => {
            if (!keys.signal.aborted) this.#failed(thrown);
          });
      }, ScreenSpaceEventType.LEFT_CLICK);
      handler.setInputAction(() => {
        void last.then(finish);
      }, ScreenSpaceEventType.LEFT_DOUBLE_CLICK);
      document.addEventListener(
        "keydown",
        ({ key }) => {
          if (key === "Enter") void last.then(finish);
          else if (key === "Escape") end(undefined);
        },
        { signal: keys.signal },
      );
      this.#end.signal.addEventListener("abort", () => end(undefined), { signal: keys.signal });
      signal?.addEventListener(
        "abort",
        () => {
          reject(signal.reason);
          end(undefined);
        },
        { signal: keys.signal },
      );
    });
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

function geometryOf(kind: DrawnKind, coordinates: number[][]): Point | LineString | Polygon {
  if (kind === "Point") return new Point(coordinates[0], "XYZ");
  if (kind === "LineString" || coordinates.length < 3) return new LineString(coordinates, "XYZ");
  return new Polygon([[...coordinates, coordinates[0]]], "XYZ");
}

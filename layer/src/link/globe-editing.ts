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

/** Draws shared features on the globe, and moves their vertices there. */
export class GlobeEditing {
  readonly #globe: GlobeSide;
  readonly #features: SharedFeatures;
  readonly #failed: (thrown: unknown) => void;
  readonly #end = new AbortController();
  #held: SharedVertex | undefined;
  /** Where the pointer was last, until it is worked through. */
  #next: { readonly x: number; readonly y: number } | undefined;
  #busy = false;

  /** @param failed called with what kept a record from being read */
  constructor(globe: GlobeSide, features: SharedFeatures, failed: (thrown: unknown) => void) {
    this.#globe = globe;
    this.#features = features;
    this.#failed = failed;
    const { canvas, screenSpaceCameraController: camera } = globe.scene;
    const { signal } = this.#end;
    canvas.addEventListener(
      "pointerdown",
      ({ offsetX: x, offsetY: y, button, pointerId }) => {
        if (button !== 0) return;
        this.#held = features.vertexAt({ x, y });
        if (!this.#held) return;
        // The drag is the vertex's, not the camera's.
        camera.enableInputs = false;
        canvas.setPointerCapture(pointerId);
      },
      { signal },
    );
    canvas.addEventListener(
      "pointermove",
      ({ offsetX: x, offsetY: y }) => {
        if (!this.#held) return;
        this.#next = { x, y };
        if (!this.#busy) void this.#move();
      },
      { signal },
    );
    for (const event of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(
        event,
        () => {
          if (!this.#held) return;
          camera.enableInputs = true;
          if (!this.#busy) this.#held = undefined;
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
    return new Promise((resolve, reject) => {
      const end = (drawn: Feature | undefined) => {
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
    if (this.#held) this.#globe.scene.screenSpaceCameraController.enableInputs = true;
    this.#end.abort();
  }

  async #move(): Promise<void> {
    const { signal } = this.#end;
    this.#busy = true;
    for (let at = this.#next; at && this.#held; at = this.#next) {
      this.#next = undefined;
      try {
        const place = await this.#globe.placeAt(at, signal);
        if (place && !signal.aborted) this.#features.move(this.#held, place);
      } catch (thrown) {
        if (!signal.aborted) this.#failed(thrown);
      }
    }
    this.#busy = false;
    if (this.#globe.scene.screenSpaceCameraController.enableInputs) this.#held = undefined;
  }
}

function geometryOf(kind: DrawnKind, coordinates: number[][]): Point | LineString | Polygon {
  if (kind === "Point") return new Point(coordinates[0], "XYZ");
  if (kind === "LineString" || coordinates.length < 3) return new LineString(coordinates, "XYZ");
  return new Polygon([[...coordinates, coordinates[0]]], "XYZ");
}

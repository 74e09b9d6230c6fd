import type { PointCloudLayer } from "@groma/layer/cesium";
import type { Measurement } from "@groma/layer/tools";
import type { Viewer } from "cesium";
import type { Beside } from "./map/beside.js";
import { freeArea } from "./panel/fold.js";
import { type Aspect, type Flight, goToCloud, goToPlaces, goToView } from "./scene/camera.js";

/**
 * Takes the camera to what the reader asks for: at once where the page's address or the reader's system wants no flights, and
 * where a map hides the globe.
 */
export class Travel {
  /** Whether the page's address lets the camera fly. */
  flies = true;
  readonly #viewer: Viewer;
  readonly #beside: () => Beside;

  /** @param beside the map beside the globe, asked for when it is there */
  constructor(viewer: Viewer, beside: () => Beside) {
    this.#viewer = viewer;
    this.#beside = beside;
  }

  /** To where all of a cloud is seen, beside what lies over the canvas. */
  toCloud(layer: PointCloudLayer, aspect: Aspect, by: Flight["way"] = "fly"): Promise<void> {
    return goToCloud(this.#viewer, layer, { aspect, free: freeArea(), way: this.#way(by) });
  }

  /** To what was measured, on globe and map; to the camera of an annotation that has one. */
  toMeasurement({ vertices, note }: Measurement): void {
    if (note?.camera) goToView(this.#viewer, note.camera, this.#way("fly"));
    else goToPlaces(this.#viewer, vertices, this.#way("fly"));
    const beside = this.#beside();
    // A linked map comes along; moved for itself it would stop the globe's flight.
    if (!beside.linked) void beside.view?.then((view) => view.goTo(vertices));
  }

  #way(wanted: Flight["way"]): Flight["way"] {
    const still =
      !this.flies || this.#beside().alone || matchMedia("(prefers-reduced-motion: reduce)").matches;
    return still ? "jump" : wanted;
  }
}

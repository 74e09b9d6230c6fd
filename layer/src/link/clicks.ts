import type { Vector } from "@groma/georef";
import { ScreenSpaceEventHandler, ScreenSpaceEventType } from "cesium";
import type MapBrowserEvent from "ol/MapBrowserEvent.js";
import { unByKey } from "ol/Observable.js";
import type { GlobeSide } from "./globe-side.js";
import type { MapSide } from "./map-side.js";

/** A click on one side takes the other there. */
export class Clicks {
  readonly #handler: ScreenSpaceEventHandler;
  readonly #key: Parameters<typeof unByKey>[0];
  readonly #failed: (thrown: unknown) => void;
  #stop = new AbortController();

  /**
   * @param seconds of a flight, asked for anew each time
   * @param failed called with what kept a record from being read
   */
  constructor(globe: GlobeSide, map: MapSide, seconds: () => number, failed: (thrown: unknown) => void) {
    this.#failed = failed;
    this.#handler = new ScreenSpaceEventHandler(globe.scene.canvas);
    this.#handler.setInputAction(({ position }: ScreenSpaceEventHandler.PositionedEvent) => {
      void this.#go(
        (signal) => globe.placeAt({ x: position.x, y: position.y }, signal),
        (place) => map.flyTo(place, seconds()),
      );
    }, ScreenSpaceEventType.LEFT_CLICK);
    this.#key = map.map.on("singleclick", ({ pixel, coordinate }: MapBrowserEvent) => {
      const [longitude, latitude] = map.plane.inverse(coordinate[0], coordinate[1]);
      const height = globe.heightAt(longitude, latitude);
      void this.#go(
        (signal) => map.placeAt([pixel[0], pixel[1]], height, signal),
        (place) => globe.flyTo(place, seconds()),
      );
    });
  }

  dispose(): void {
    this.#stop.abort();
    this.#handler.destroy();
    unByKey(this.#key);
  }

  /** Goes to the place of the last click. */
  async #go(
    find: (signal: AbortSignal) => Promise<Vector | undefined>,
    go: (place: Vector) => void,
  ): Promise<void> {
    this.#stop.abort();
    this.#stop = new AbortController();
    const { signal } = this.#stop;
    try {
      const place = await find(signal);
      if (place && !signal.aborted) go(place);
    } catch (thrown) {
      if (!signal.aborted) this.#failed(thrown);
    }
  }
}

import type { Vector } from "@groma/georef";
import { ScreenSpaceEventHandler, ScreenSpaceEventType } from "cesium";
import type MapBrowserEvent from "ol/MapBrowserEvent.js";
import { unByKey } from "ol/Observable.js";
import { DRAWING_CLASS } from "../tools/draw/view-adapter.js";
import type { GlobeSide } from "./globe-side.js";
import type { MapSide } from "./map-side.js";

/** What flights to what is clicked go by. */
export interface ClickOptions {
  /** Of a flight, asked for anew each time. */
  readonly seconds: () => number;
  /** Whether the reader draws or changes something on the globe: clicks are for that then. */
  readonly busy: () => boolean;
  /** Called with what kept a record from being read. */
  readonly failed: (thrown: unknown) => void;
}

/** A click on one side takes the other there, while it is active and the click is not part of a figure. */
export class Clicks {
  readonly #globe: GlobeSide;
  readonly #map: MapSide;
  readonly #options: ClickOptions;
  /** Ends listening. */
  #end: (() => void) | undefined;
  #stop = new AbortController();

  constructor(globe: GlobeSide, map: MapSide, options: ClickOptions) {
    this.#globe = globe;
    this.#map = map;
    this.#options = options;
  }

  get active(): boolean {
    return this.#end !== undefined;
  }

  set active(active: boolean) {
    if (active) this.#end ??= this.#listen();
    else {
      this.#stop.abort();
      this.#end?.();
      this.#end = undefined;
    }
  }

  #listen(): () => void {
    const [globe, map] = [this.#globe, this.#map];
    const { seconds, busy } = this.#options;
    const { canvas } = globe.scene;
    const ofGlobe = new Press(canvas, busy);
    const handler = new ScreenSpaceEventHandler(canvas);
    handler.setInputAction(({ position }: ScreenSpaceEventHandler.PositionedEvent) => {
      if (ofGlobe.draws || !globe.lives) return;
      void this.#go(
        (signal) => globe.placeAt({ x: position.x, y: position.y }, signal),
        (place) => map.flyTo(place, seconds()),
      );
    }, ScreenSpaceEventType.LEFT_CLICK);
    const ofMap = new Press(map.map.getViewport(), () => busy() || map.drawing);
    // A single click is told of a quarter of a second later, when the pointer may be down for something else.
    const ofFigures = new WeakSet<object>();
    const click = map.map.on("click", ({ originalEvent }: MapBrowserEvent) => {
      if (ofMap.draws) ofFigures.add(originalEvent);
    });
    const single = map.map.on("singleclick", ({ pixel, coordinate, originalEvent }: MapBrowserEvent) => {
      if (ofFigures.has(originalEvent) || !globe.lives) return;
      const [longitude, latitude] = map.plane.inverse(coordinate[0], coordinate[1]);
      const height = globe.heightAt(longitude, latitude);
      void this.#go(
        (signal) => map.placeAt([pixel[0], pixel[1]], height, signal),
        (place) => globe.flyTo(place, seconds()),
      );
    });
    return () => {
      handler.destroy();
      for (const press of [ofGlobe, ofMap]) press.end();
      unByKey([click, single]);
    };
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
      if (place && !signal.aborted && this.#globe.lives) go(place);
    } catch (thrown) {
      if (!signal.aborted) this.#options.failed(thrown);
    }
  }
}

/**
 * Whether the pointer was pressed last on a view to draw there: asked for as it is pressed, since the click that follows may
 * end the figure, and have its interaction taken away, before it is told of.
 */
class Press {
  readonly #view: HTMLElement;
  readonly #busy: () => boolean;
  #draws = false;

  constructor(view: HTMLElement, busy: () => boolean) {
    this.#view = view;
    this.#busy = busy;
    view.addEventListener("pointerdown", this.#pressed, { capture: true });
  }

  get draws(): boolean {
    return this.#draws;
  }

  end(): void {
    this.#view.removeEventListener("pointerdown", this.#pressed, { capture: true });
  }

  readonly #pressed = (): void => {
    this.#draws = this.#busy() || this.#view.classList.contains(DRAWING_CLASS);
  };
}

import type { Vector } from "@groma/georef";
import { Cartesian3, Color, type PointPrimitive, PointPrimitiveCollection } from "cesium";
import Feature from "ol/Feature.js";
import Point from "ol/geom/Point.js";
import VectorLayer from "ol/layer/Vector.js";
import type MapBrowserEvent from "ol/MapBrowserEvent.js";
import { unByKey } from "ol/Observable.js";
import VectorSource from "ol/source/Vector.js";
import Circle from "ol/style/Circle.js";
import Fill from "ol/style/Fill.js";
import Stroke from "ol/style/Stroke.js";
import Style from "ol/style/Style.js";
import type { GlobeSide } from "./globe-side.js";
import { ACCENT } from "./looks.js";
import type { MapSide } from "./map-side.js";

/** Where a pointer is: what finds its place, or undefined where it has left. */
type Search = ((signal: AbortSignal) => Promise<Vector | undefined>) | undefined;

/**
 * The place under the pointer of one side, shown on the other: that of the point that is drawn there, as it is recorded;
 * where there is none, of the ground. One search runs at a time, and the last pointer wins.
 */
export class Cursors {
  readonly #globe: GlobeSide;
  readonly #map: MapSide;
  readonly #failed: (thrown: unknown) => void;
  readonly #end = new AbortController();
  readonly #key: Parameters<typeof unByKey>[0];
  readonly #mark = new Feature<Point>();
  readonly #layer: VectorLayer;
  readonly #points: PointPrimitiveCollection;
  readonly #point: PointPrimitive;
  /** What is to be searched next, and how what it finds is shown. */
  #next: { readonly search: Search; readonly show: (place: Vector | undefined) => void } | undefined;
  #busy = false;

  /** @param failed called with what kept a record from being read */
  constructor(globe: GlobeSide, map: MapSide, failed: (thrown: unknown) => void) {
    this.#globe = globe;
    this.#map = map;
    this.#failed = failed;
    const image = new Circle({
      radius: 6,
      stroke: new Stroke({ color: ACCENT, width: 2 }),
      fill: new Fill({ color: "rgba(0, 0, 0, 0.35)" }),
    });
    this.#layer = new VectorLayer({
      source: new VectorSource({ features: [this.#mark], wrapX: true }),
      style: new Style({ image }),
      updateWhileAnimating: true,
      updateWhileInteracting: true,
    });
    this.#layer.setMap(map.map);
    const { primitives, canvas } = globe.scene;
    this.#points = primitives.add(new PointPrimitiveCollection());
    this.#point = this.#points.add({
      show: false,
      pixelSize: 10,
      color: Color.BLACK.withAlpha(0.35),
      outlineColor: Color.fromCssColorString(ACCENT),
      outlineWidth: 2,
      disableDepthTestDistance: Number.POSITIVE_INFINITY,
    });
    const { signal } = this.#end;
    const onGlobe = (place: Vector | undefined) => this.#showOnGlobe(place);
    const onMap = (place: Vector | undefined) => this.#showOnMap(place);
    canvas.addEventListener(
      "pointermove",
      ({ offsetX: x, offsetY: y, buttons }) => {
        if (buttons === 0) this.#find((stop) => this.#globe.placeAt({ x, y }, stop), onMap);
      },
      { signal },
    );
    canvas.addEventListener("pointerleave", () => this.#find(undefined, onMap), { signal });
    const viewport = map.map.getViewport();
    viewport.addEventListener("pointerleave", () => this.#find(undefined, onGlobe), { signal });
    this.#key = map.map.on("pointermove", ({ pixel, coordinate, dragging }: MapBrowserEvent) => {
      if (!dragging) this.#find((stop) => this.#placeOnMap(pixel, coordinate, stop), onGlobe);
    });
  }

  /** The mark on the map. */
  get feature(): Feature<Point> {
    return this.#mark;
  }

  /** The mark on the globe. */
  get point(): PointPrimitive {
    return this.#point;
  }

  dispose(): void {
    this.#end.abort();
    unByKey(this.#key);
    this.#layer.setMap(null);
    this.#layer.dispose();
    if (!this.#globe.lives) return;
    this.#globe.scene.primitives.remove(this.#points);
    this.#globe.scene.requestRender();
  }

  #placeOnMap(pixel: number[], coordinate: number[], signal: AbortSignal): Promise<Vector | undefined> {
    const { plane } = this.#map;
    const [longitude, latitude] = plane.inverse(coordinate[0], coordinate[1]);
    return this.#map.placeAt([pixel[0], pixel[1]], this.#globe.heightAt(longitude, latitude), signal);
  }

  #find(search: Search, show: (place: Vector | undefined) => void): void {
    if (!this.#globe.lives) return;
    this.#next = { search, show };
    if (!this.#busy) void this.#work();
  }

  async #work(): Promise<void> {
    const { signal } = this.#end;
    this.#busy = true;
    for (let now = this.#next; now && !signal.aborted; now = this.#next) {
      this.#next = undefined;
      try {
        const place = await now.search?.(signal);
        if (!signal.aborted && this.#globe.lives) now.show(place);
      } catch (thrown) {
        if (!signal.aborted) this.#failed(thrown);
      }
    }
    this.#busy = false;
  }

  #showOnMap(place: Vector | undefined): void {
    const coordinate = place && this.#map.coordinateOf(place);
    this.#mark.setGeometry(coordinate && new Point([...coordinate]));
  }

  #showOnGlobe(place: Vector | undefined): void {
    this.#point.show = place !== undefined;
    if (place) this.#point.position = new Cartesian3(...place);
    this.#globe.scene.requestRender();
  }
}

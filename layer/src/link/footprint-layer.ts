import Feature from "ol/Feature.js";
import Polygon from "ol/geom/Polygon.js";
import VectorLayer from "ol/layer/Vector.js";
import VectorSource from "ol/source/Vector.js";
import Fill from "ol/style/Fill.js";
import Stroke from "ol/style/Stroke.js";
import Style from "ol/style/Style.js";
import { ringOnMap } from "./geometry/index.js";
import type { GlobeSide } from "./globe-side.js";
import { ACCENT } from "./looks.js";
import type { MapSide } from "./map-side.js";

const STYLE = [
  new Style({ stroke: new Stroke({ color: "rgba(0, 0, 0, 0.6)", width: 3 }) }),
  new Style({
    stroke: new Stroke({ color: ACCENT, width: 1.5 }),
    fill: new Fill({ color: "rgba(242, 184, 75, 0.08)" }),
  }),
];

/** The ground that the globe's camera sees, as a polygon over the map. */
export class FootprintLayer {
  readonly feature = new Feature<Polygon>();
  readonly layer: VectorLayer;
  readonly #globe: GlobeSide;
  readonly #map: MapSide;

  constructor(globe: GlobeSide, map: MapSide) {
    this.#globe = globe;
    this.#map = map;
    const source = new VectorSource({ features: [this.feature], wrapX: true });
    this.layer = new VectorLayer({
      source,
      style: STYLE,
      updateWhileAnimating: true,
      updateWhileInteracting: true,
    });
    // Over the map's own layers, whatever their order, and not among them.
    this.layer.setMap(map.map);
    this.update();
  }

  /** Draws the footprint as it is now. */
  update(): void {
    const { plane, edge, view } = this.#map;
    const outline = this.#globe.shown ? this.#globe.footprint : [];
    const ring = ringOnMap(outline, plane, view?.center[0] ?? 0, edge);
    this.feature.setGeometry(ring.length > 0 ? new Polygon([[...ring, ring[0]]]) : undefined);
  }

  dispose(): void {
    this.layer.setMap(null);
    this.layer.dispose();
  }
}

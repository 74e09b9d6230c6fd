import type { PointCloudLayer } from "@groma/layer/cesium";
import { PointCloudLayer as MapLayer, PointCloudSource } from "@groma/layer/openlayers";
import type OlMap from "ol/Map.js";

/** A cloud of the globe on the map, drawn as it is there. */
export class MapCloud {
  readonly globe: PointCloudLayer;
  readonly layer: MapLayer;
  readonly #source: PointCloudSource;
  /** What of the layer on the globe the map has taken over. */
  #followed: readonly unknown[];

  /** @param failed told of what cannot be drawn */
  constructor(map: OlMap, globe: PointCloudLayer, failed: (thrown: unknown) => void) {
    this.globe = globe;
    this.#source = new PointCloudSource({ cloud: globe.cloud });
    const { style, filter, clips, maximumScreenSpaceError, pointBudget } = globe;
    const options = { source: this.#source, style, filter, clips, maximumScreenSpaceError, pointBudget };
    this.layer = new MapLayer(options);
    this.layer.setVisible(globe.show);
    this.layer.addEventListener("error", (event) => failed((event as unknown as { error: Error }).error));
    this.#followed = partsOf(globe);
    map.addLayer(this.layer);
  }

  /** Of the map's projection; undefined where the cloud has no place on it. */
  get extent() {
    return this.#source.getExtent();
  }

  /** Takes over what has changed of the layer on the globe. */
  follow(): void {
    const { globe, layer } = this;
    if (globe.isDestroyed()) return;
    const parts = partsOf(globe);
    if (parts.every((part, at) => part === this.#followed[at])) return;
    this.#followed = parts;
    layer.style = globe.style;
    layer.filter = globe.filter;
    layer.clips = globe.clips;
    layer.maximumScreenSpaceError = globe.maximumScreenSpaceError;
    layer.pointBudget = globe.pointBudget;
    layer.setVisible(globe.show);
  }

  leave(map: OlMap): void {
    map.removeLayer(this.layer);
    this.layer.dispose();
    this.#source.dispose();
  }
}

function partsOf(layer: PointCloudLayer): unknown[] {
  const { style, filter, clips, maximumScreenSpaceError, pointBudget, show } = layer;
  return [style, filter, clips, maximumScreenSpaceError, pointBudget, show];
}

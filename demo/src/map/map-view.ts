import "ol/ol.css";
import { ecefToGeodetic } from "@groma/georef";
import type { PointCloudLayer } from "@groma/layer/cesium";
import { type Link, synchronize } from "@groma/layer/link";
import { type LayerStatistics, type LedgerRow, measureView } from "@groma/layer/openlayers";
import type { ViewAdapter } from "@groma/layer/tools";
import { buildModuleUrl, type Viewer } from "cesium";
import { defaults } from "ol/control/defaults.js";
import { boundingExtent } from "ol/extent.js";
import TileLayer from "ol/layer/Tile.js";
import OlMap from "ol/Map.js";
import Overlay from "ol/Overlay.js";
import { fromLonLat, get as projectionOf } from "ol/proj.js";
import TileImage from "ol/source/TileImage.js";
import TileGrid from "ol/tilegrid/TileGrid.js";
import View from "ol/View.js";
import { i18n } from "../language/i18n.js";
import { textElement } from "../panel/elements.js";
import { freeArea } from "../panel/fold.js";
import type { ViewShot } from "../screenshot/view-shot.js";
import { MapCloud } from "./map-cloud.js";
import { creditsOf, shootMap } from "./map-shot.js";

/** Levels of the Natural Earth map that comes with Cesium, degrees per pixel. */
const RESOLUTIONS = [180 / 256, 90 / 256, 45 / 256];

/** Pixels around places that are gone to. */
const AROUND = [80, 80, 80, 80];
/** Of one point its surroundings are shown: units of the projection per pixel. */
const FINEST = 0.05;

/** A map beside the globe that shows the same clouds from above, drawn as the layers on the globe are. */
export class MapView {
  readonly map: OlMap;
  readonly #viewer: Viewer;
  readonly #failed: (thrown: unknown) => void;
  /** Where a tool points to. */
  readonly #mark = new Overlay({
    element: textElement("div", "", "map-mark"),
    positioning: "center-center",
    stopEvent: false,
  });
  #link: Link | undefined;
  /** What of it was asked for last. */
  #marks: boolean | undefined;
  #clouds: readonly MapCloud[] = [];
  /** The layer on the globe that the panel speaks of. */
  #chosen: PointCloudLayer | undefined;

  /** @param failed told of what the map cannot draw */
  constructor(target: HTMLElement, viewer: Viewer, failed: (thrown: unknown) => void) {
    this.#viewer = viewer;
    this.#failed = failed;
    this.map = new OlMap({
      target,
      layers: [baseMap()],
      controls: defaults({
        zoomOptions: { zoomInTipLabel: i18n.t("Zoom in"), zoomOutTipLabel: i18n.t("Zoom out") },
        rotateOptions: { tipLabel: i18n.t("North up") },
        attributionOptions: { tipLabel: i18n.t("Sources of the map") },
      }),
      // Turned as the globe is, also by a degree.
      view: new View({ center: [0, 0], zoom: 1, maxZoom: 26, constrainRotation: false }),
    });
    this.map.addOverlay(this.#mark);
    viewer.scene.postRender.addEventListener(() => this.#takeOver());
  }

  /** What of the chosen cloud the map draws; undefined where there is none. */
  get statistics(): LayerStatistics | undefined {
    return this.#ofChosen?.statistics;
  }

  /** The effects of what it draws of the chosen cloud. */
  get ledger(): readonly LedgerRow[] | undefined {
    return this.#ofChosen?.ledger;
  }

  /** Lets nodes that failed be asked for again. */
  retryFailed(): void {
    for (const { layer } of this.#clouds) layer.retryFailed();
  }

  get #ofChosen(): MapCloud["layer"] | undefined {
    return this.#clouds.find(({ globe }) => globe === this.#chosen)?.layer;
  }

  /** Shows the clouds of the globe, and no others. @param chosen one of them: the map goes there when it comes */
  attach(layers: readonly PointCloudLayer[], chosen: PointCloudLayer | undefined): void {
    this.map.updateSize();
    const gone = this.#clouds.filter(({ globe }) => !layers.includes(globe));
    for (const cloud of gone) cloud.leave(this.map);
    this.#clouds = layers.map((globe) => {
      const there = this.#clouds.find((cloud) => cloud.globe === globe);
      return there ?? new MapCloud(this.map, globe, this.#failed);
    });
    if (chosen === this.#chosen) return;
    this.#chosen = chosen;
    // A map in step shows what the globe does.
    const extent = this.#link ? undefined : this.#clouds.find(({ globe }) => globe === chosen)?.extent;
    if (extent && this.map.getSize()) this.map.getView().fit(extent, { padding: [24, 24, 24, 24] });
  }

  /**
   * Keeps the map in step with the globe from now on; undefined: no longer.
   * @param options whether north stays up, and whether the map marks what is seen of the globe
   */
  link(options: { readonly northUp: boolean; readonly marks: boolean } | undefined): void {
    if (options?.marks !== this.#marks) {
      this.#link?.dispose();
      this.#link = undefined;
    }
    this.#marks = options?.marks;
    if (!options) return;
    const { marks } = options;
    const shown = { footprint: marks, camera: marks, cursor: marks };
    // Beside the globe the map lies free; in its place the panel covers both alike.
    const views = { viewer: this.#viewer, map: this.map, middle: marks ? middle : undefined };
    this.#link ??= synchronize({ ...views, ...shown, onError: this.#failed });
    if (options.northUp) this.map.getView().setRotation(0);
    this.#link.northUp = options.northUp;
  }

  /** Takes over what has changed of a globe that draws no frames. */
  follow(): void {
    this.#link?.update();
    this.#takeOver();
  }

  /** Takes over what has changed of the layers on the globe. */
  #takeOver(): void {
    for (const cloud of this.#clouds) cloud.follow();
  }

  /** The map, for measuring on it. */
  get measured(): ViewAdapter {
    const view = measureView(this.map, () => this.#clouds.map(({ layer }) => layer));
    return { ...view, name: i18n.t("map") };
  }

  /** A picture of the map once it is complete, and what it says of its sources. @throws the signal's reason */
  async shoot(
    signal: AbortSignal,
  ): Promise<{ readonly shot: ViewShot; readonly credits: readonly string[] }> {
    return { shot: await shootMap(this.map, signal), credits: creditsOf(this.map) };
  }

  /** Marks a place; undefined: none. @param place ECEF, metres */
  mark(place: ArrayLike<number> | undefined): void {
    if (!place) {
      this.#mark.setPosition(undefined);
      return;
    }
    const geodetic = new Float64Array(3);
    ecefToGeodetic(place[0]!, place[1]!, place[2]!, geodetic);
    const degrees = [geodetic[0]!, geodetic[1]!].map((angle) => angle * (180 / Math.PI));
    this.#mark.setPosition(fromLonLat(degrees, this.map.getView().getProjection()));
  }

  /** Shows places in the middle, WGS 84, radians. */
  goTo(places: readonly { readonly longitude: number; readonly latitude: number }[]): void {
    const view = this.map.getView();
    const first = places[0]?.longitude ?? 0;
    const degrees = places.map(({ longitude, latitude }) => {
      // The shorter way around from the first: a line across the antimeridian is not the world.
      const turns = Math.round((first - longitude) / (2 * Math.PI));
      return [longitude + 2 * Math.PI * turns, latitude].map((one) => one * (180 / Math.PI));
    });
    const extent = boundingExtent(degrees.map((one) => fromLonLat(one, view.getProjection())));
    if (extent.every(Number.isFinite)) view.fit(extent, { padding: AROUND, minResolution: FINEST });
  }
}

/** The middle of what the panel leaves of the globe. */
function middle(): { x: number; y: number } {
  const { left, right, top, bottom } = freeArea();
  return { x: (left + right) / 2, y: (top + bottom) / 2 };
}

/** The Natural Earth map that comes with Cesium, whose rows are counted from the south. */
function baseMap(): TileLayer {
  const folder = buildModuleUrl("Assets/Textures/NaturalEarthII");
  const source = new TileImage({
    projection: projectionOf("EPSG:4326") ?? "EPSG:4326",
    tileGrid: new TileGrid({ origin: [-180, 90], resolutions: RESOLUTIONS, extent: [-180, -90, 180, 90] }),
    tileUrlFunction: ([z, x, y]) => `${folder}/${z}/${x}/${2 ** z - 1 - y}.jpg`,
    attributions: "Natural Earth",
    wrapX: true,
  });
  return new TileLayer({ source, className: "base" });
}

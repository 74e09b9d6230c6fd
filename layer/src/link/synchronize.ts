import type { Scene } from "cesium";
import type Feature from "ol/Feature.js";
import type Polygon from "ol/geom/Polygon.js";
import type OlMap from "ol/Map.js";
import { flag, type Kinds, kindOf, oneOf, optionPlace, parts, withMethods } from "../options/index.js";
import { FootprintLayer } from "./footprint-layer.js";
import { GlobeSide } from "./globe-side.js";
import { MapSide } from "./map-side.js";
import { type Move, ViewLink, type ViewMode } from "./view-link.js";

/** How a globe and a map are linked. */
export interface LinkOptions {
  /** A `Viewer` or a `CesiumWidget` of Cesium. */
  readonly viewer: { readonly scene: Scene };
  readonly map: OlMap;
  /**
   * Which view follows which: `both`, the map only (`to-map`), the globe only (`to-globe`), or `none`. Default: `both`;
   * at first the map takes over what the globe shows.
   */
  readonly view?: ViewMode | undefined;
  /** Whether the map and the globe keep their turn, whatever the other's is. Default: false. */
  readonly northUp?: boolean | undefined;
  /** Whether the map shows the ground that the globe's camera sees. Default: true. */
  readonly footprint?: boolean | undefined;
  /** Hears what kept a record from being read. Default: `reportError`. */
  readonly onError?: ((thrown: unknown) => void) | undefined;
}

/** All options, those by default among them. */
type Complete = { readonly [Name in keyof LinkOptions]-?: NonNullable<LinkOptions[Name]> };

const KINDS: Kinds<Complete> = {
  viewer: kindOf("a Viewer of Cesium", (given): given is LinkOptions["viewer"] => {
    const { scene } = (given ?? {}) as { scene?: { camera?: unknown; preRender?: unknown } };
    return typeof scene === "object" && scene?.camera !== undefined && scene.preRender !== undefined;
  }),
  map: withMethods<OlMap>("a Map of OpenLayers", "getView", "getAllLayers"),
  view: oneOf("both", "to-map", "to-globe", "none"),
  northUp: flag,
  footprint: flag,
  onError: kindOf("a function", (given): given is Complete["onError"] => typeof given === "function"),
};
const DEFAULTS: Partial<Complete> = {
  ...{ view: "both", northUp: false, footprint: true },
  onError: (thrown) => reportError(thrown),
};
const PLACE = "synchronize";

/**
 * Keeps a globe of Cesium and a map of OpenLayers in step.
 *
 * The middle of the map is the place that the globe's camera looks at, on the terrain, on the points or on the ellipsoid,
 * and a pixel there covers as much ground on both. Nothing is done while nothing moves.
 * @throws StyleError STYLE_OPTION
 */
export function synchronize(options: LinkOptions): Link {
  return new Link(options);
}

/** A globe and a map in step, until `dispose()`. */
export class Link {
  readonly #globe: GlobeSide;
  readonly #map: MapSide;
  readonly #views: ViewLink;
  readonly #footprint: FootprintLayer | undefined;
  readonly #listeners = new Set<(move: Move) => void>();
  #disposed = false;

  /** @throws StyleError STYLE_OPTION */
  constructor(options: LinkOptions) {
    const place = optionPlace("options", PLACE);
    const { viewer, map, view, northUp, footprint, onError } = parts(KINDS, DEFAULTS).read(options, place);
    this.#globe = new GlobeSide(viewer.scene, () => this.#views.globeMoved());
    this.#map = new MapSide(map, () => this.#views.mapMoved());
    const told = (move: Move | undefined) => this.#told(move);
    this.#views = new ViewLink(this.#globe, this.#map, { mode: view, northUp }, told, onError);
    if (footprint) this.#footprint = new FootprintLayer(this.#globe, this.#map);
    this.#views.carry();
  }

  /** Which view follows which. @throws StyleError STYLE_OPTION */
  get view(): ViewMode {
    return this.#views.mode;
  }

  set view(mode: ViewMode) {
    this.#views.mode = KINDS.view.read(mode, optionPlace("view", PLACE));
    if (!this.#disposed) this.#views.carry();
  }

  /** Whether the map and the globe keep their turn. @throws StyleError STYLE_OPTION */
  get northUp(): boolean {
    return this.#views.northUp;
  }

  set northUp(northUp: boolean) {
    this.#views.northUp = KINDS.northUp.read(northUp, optionPlace("northUp", PLACE));
    if (!this.#disposed) this.#views.carry();
  }

  /** The ground that the globe's camera sees, in the projection of the map; undefined where it is not shown. */
  get footprint(): Feature<Polygon> | undefined {
    return this.#footprint?.feature;
  }

  /** Calls back after each move that was carried over. @returns what ends that */
  onMove(listener: (move: Move) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Ends the link and takes away all that it has put on the globe and the map. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#views.dispose();
    this.#footprint?.dispose();
    this.#globe.dispose();
    this.#map.dispose();
    this.#listeners.clear();
  }

  #told(move: Move | undefined): void {
    this.#footprint?.update();
    if (!move) return;
    for (const listener of this.#listeners) listener(move);
  }
}

import type { Vector } from "@groma/georef";
import type { PointPrimitive, Scene } from "cesium";
import type Feature from "ol/Feature.js";
import type Point from "ol/geom/Point.js";
import type Polygon from "ol/geom/Polygon.js";
import type Draw from "ol/interaction/Draw.js";
import type OlMap from "ol/Map.js";
import VectorSource from "ol/source/Vector.js";
import type { ScreenPlace } from "../camera/index.js";
import { isAbort } from "../errors/index.js";
import {
  flag,
  type Kinds,
  kindOf,
  number,
  oneOf,
  optionPlace,
  parts,
  withMethods,
} from "../options/index.js";
import { CameraHandle } from "./camera-handle.js";
import { Clicks } from "./clicks.js";
import { Cursors } from "./cursors.js";
import { FootprintLayer } from "./footprint-layer.js";
import type { DrawnKind } from "./globe-drawing.js";
import { GlobeEditing } from "./globe-editing.js";
import { GlobeSide } from "./globe-side.js";
import { MapSide } from "./map-side.js";
import { SharedFeatures } from "./shared-features.js";
import { type Move, ViewLink, type ViewMode } from "./view-link.js";

/** How a globe and a map are linked. */
export interface LinkOptions {
  /** A `Viewer` or a `CesiumWidget` of Cesium. */
  readonly viewer: { readonly scene: Scene };
  /** A `Map` of OpenLayers. */
  readonly map: OlMap;
  /**
   * Which view follows which: `both`, the map only (`to-map`), the globe only (`to-globe`), or `none`. Default: `both`;
   * at first the map takes over what the globe shows.
   */
  readonly view?: ViewMode | undefined;
  /** Whether the map and the globe keep their turn, whatever the other's is. Default: false. */
  readonly northUp?: boolean | undefined;
  /**
   * The place of the globe's picture whose ground is in the middle of the map, CSS pixels from its upper left, where
   * something covers a part of the picture. Asked for at each move. Default: half of its size.
   */
  readonly middle?: (() => ScreenPlace) | undefined;
  /** Whether the map shows the ground that the globe's camera sees. Default: true. */
  readonly footprint?: boolean | undefined;
  /** Whether the map shows the globe's camera, which can be dragged and turned there. Default: true. */
  readonly camera?: boolean | undefined;
  /** Whether the place under the pointer of one side is marked on the other. Default: true. */
  readonly cursor?: boolean | undefined;
  /** Whether a click on one side takes the other there. Default: false. */
  readonly click?: boolean | undefined;
  /** Seconds of a flight that a click sets off; 0 for readers who asked for less motion. Default: 1.5. */
  readonly flight?: number | undefined;
  /**
   * Features of the map that the globe shows as well. Their vertices can be dragged on the globe, and others drawn there
   * (`draw`); what is drawn on the map shows on the globe meanwhile (`follow`).
   */
  readonly features?: VectorSource | undefined;
  /** Hears what kept a record from being read. Default: `reportError`. */
  readonly onError?: ((thrown: unknown) => void) | undefined;
}

/** Options without a default. */
type Without = "middle" | "features";
/** All options, those by default among them. */
type Complete = Pick<LinkOptions, Without> & {
  readonly [Name in Exclude<keyof LinkOptions, Without>]-?: NonNullable<LinkOptions[Name]>;
};

const KINDS: Kinds<Complete> = {
  viewer: kindOf("a Viewer of Cesium", (given): given is LinkOptions["viewer"] => {
    const { scene } = (given ?? {}) as { scene?: { camera?: unknown; preRender?: unknown } };
    return typeof scene === "object" && scene?.camera !== undefined && scene.preRender !== undefined;
  }),
  map: withMethods<OlMap>("a Map of OpenLayers", "getView", "getAllLayers"),
  view: oneOf("both", "to-map", "to-globe", "none"),
  northUp: flag,
  middle: kindOf(
    "a function",
    (given): given is Complete["middle"] => given === undefined || isFunction(given),
  ),
  footprint: flag,
  camera: flag,
  cursor: flag,
  click: flag,
  flight: number(0, 60),
  features: kindOf(
    "a VectorSource of OpenLayers",
    (given): given is Complete["features"] => given === undefined || given instanceof VectorSource,
  ),
  onError: kindOf("a function", (given): given is Complete["onError"] => isFunction(given)),
};
const DEFAULTS: Partial<Complete> = {
  ...{ view: "both", northUp: false, footprint: true, camera: true, cursor: true, click: false, flight: 1.5 },
  onError: (thrown) => reportError(thrown),
};
const PLACE = "synchronize";

function isFunction(given: unknown): boolean {
  return typeof given === "function";
}

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
  readonly #handle: CameraHandle | undefined;
  readonly #cursors: Cursors | undefined;
  readonly #clicks: Clicks;
  readonly #shared: SharedFeatures | undefined;
  readonly #editing: GlobeEditing | undefined;
  readonly #listeners = new Set<(move: Move) => void>();
  #disposed = false;

  /** @throws StyleError STYLE_OPTION */
  constructor(options: LinkOptions) {
    const given = parts(KINDS, DEFAULTS).read(options, optionPlace("options", PLACE));
    const { view: mode, northUp } = given;
    // A layer may go while the pointer's record is being read: nothing has failed then.
    const onError = (thrown: unknown) => {
      if (!isAbort(thrown)) given.onError(thrown);
    };
    const globe = new GlobeSide(given.viewer.scene, given.middle, {
      moved: () => this.#views.globeMoved(),
      grew: () => this.#views.grew(),
      gone: () => this.dispose(),
    });
    const map = new MapSide(given.map, {
      moved: () => this.#views.mapMoved(),
      grew: () => this.#views.grew(),
    });
    const views = new ViewLink(globe, map, { mode, northUp }, (move) => this.#told(move), onError);
    [this.#globe, this.#map, this.#views] = [globe, map, views];
    if (given.footprint) this.#footprint = new FootprintLayer(globe, map);
    if (given.camera) {
      const dragged = () => this.#told({ origin: "handle", target: "globe" });
      this.#handle = new CameraHandle(globe, map, dragged, (held) => views.hold(held));
    }
    if (given.cursor) this.#cursors = new Cursors(globe, map, onError);
    const seconds = () => (matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : given.flight);
    if (given.features) {
      this.#shared = new SharedFeatures(globe, map, given.features, onError);
      this.#editing = new GlobeEditing(globe, this.#shared, onError);
    }
    const busy = () => this.#editing?.busy ?? false;
    this.#clicks = new Clicks(globe, map, { seconds, busy, failed: onError });
    this.#clicks.active = given.click;
    views.carry();
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

  /** Whether a click on one side takes the other there, unless something is drawn. @throws StyleError STYLE_OPTION */
  get click(): boolean {
    return this.#clicks.active;
  }

  set click(click: boolean) {
    const checked = KINDS.click.read(click, optionPlace("click", PLACE));
    if (!this.#disposed) this.#clicks.active = checked;
  }

  /** The ground that the globe's camera sees, in the projection of the map; undefined where it is not shown. */
  get footprint(): Feature<Polygon> | undefined {
    return this.#footprint?.feature;
  }

  /** The globe's camera on the map; undefined where it is not shown. */
  get camera(): Feature<Point> | undefined {
    return this.#handle?.feature;
  }

  /** The marks of the pointer on the map and on the globe; undefined where there are none. */
  get cursor(): { readonly map: Feature<Point>; readonly globe: PointPrimitive } | undefined {
    return this.#cursors && { map: this.#cursors.feature, globe: this.#cursors.point };
  }

  /**
   * Shows on the globe what an interaction of the map draws, while it is drawn.
   * @returns what ends that
   * @throws StyleError STYLE_OPTION where the link has no features; an AbortError where it has ended
   */
  follow(draw: Draw): () => void {
    this.#mustLive();
    return this.#mustShare(this.#shared).follow(draw);
  }

  /**
   * Has the reader draw a feature by clicks on the globe; it is among the features from its first vertex on. A double click
   * or Enter ends it, Escape gives it up.
   * @returns undefined where the reader gives it up
   * @throws StyleError STYLE_OPTION where the link has no features; the signal's reason when aborted; an
   *   AbortError where the link has ended
   */
  async draw(kind: DrawnKind, options: { readonly signal?: AbortSignal } = {}): Promise<Feature | undefined> {
    const checked = oneOf("Point", "LineString", "Polygon").read(kind, optionPlace("kind", PLACE));
    this.#mustLive();
    return this.#mustShare(this.#editing).draw(checked, options.signal);
  }

  /**
   * Where the globe shows a feature, ECEF, metres: its vertices, and the ways of its lines with what is between them.
   * @throws StyleError STYLE_OPTION where the link has no features
   */
  placesOf(feature: Feature): { readonly vertices: readonly Vector[]; readonly ways: readonly Vector[][] } {
    return this.#mustShare(this.#shared).placesOf(feature);
  }

  /** Calls back after each move that was carried over. @returns what ends that */
  onMove(listener: (move: Move) => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /** Carries over at once what has moved of the globe, as each of its frames does: for a globe of which none is drawn. */
  update(): void {
    if (!this.#disposed && this.#globe.lives) this.#globe.look();
  }

  /** Ends the link and takes away all that it has put on the globe and the map. */
  dispose(): void {
    if (this.#disposed) return;
    this.#disposed = true;
    this.#views.dispose();
    for (const part of [this.#footprint, this.#handle, this.#cursors]) part?.dispose();
    this.#clicks.active = false;
    this.#editing?.dispose();
    this.#shared?.dispose();
    this.#globe.dispose();
    this.#map.dispose();
    this.#listeners.clear();
  }

  #mustLive(): void {
    if (this.#disposed) throw new DOMException("The link was disposed of.", "AbortError");
  }

  #mustShare<Part>(part: Part | undefined): Part {
    return part ?? optionPlace("features", PLACE).refuse("the link has no features", "give a VectorSource");
  }

  #told(move: Move | undefined): void {
    this.#footprint?.update();
    this.#handle?.update();
    this.#shared?.update();
    if (!move) return;
    for (const listener of this.#listeners) listener(move);
  }
}

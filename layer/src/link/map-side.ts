import type { Vector } from "@groma/georef";
import type { Extent } from "ol/extent.js";
import type OlMap from "ol/Map.js";
import { unByKey } from "ol/Observable.js";
import { getTransform, get as projectionOf } from "ol/proj.js";
import type View from "ol/View.js";
import { heightOf } from "../camera/index.js";
import { PointCloudLayer } from "../openlayers/index.js";
import { geodeticOf, type MapView, type Plane, placeOn, unwrapped } from "./geometry/index.js";

const DEGREE = Math.PI / 180;
const NOWHERE = [Number.NaN, Number.NaN] as const;

/** The map as a link knows it: its view and the plane that it lies in. */
export class MapSide {
  readonly map: OlMap;
  readonly #moved: () => void;
  readonly #keys: Parameters<typeof unByKey>[0];
  /** The view, as it was told last. */
  #known: MapView | undefined;
  /** The view that was asked for, of which the map's constraints may have let it show less. */
  #wanted: MapView | undefined;
  /** Whether that one's middle is beside the map's by the user's will, and goes along with it. */
  #apart = false;
  #view: View | undefined;
  #viewKey: Parameters<typeof unByKey>[0] | undefined;
  #plane: { readonly code: string; readonly plane: Plane } | undefined;
  /** Whether points were still on their way when the last frame was drawn. */
  #loading = false;

  /**
   * @param moved called when the view may be another than the one known
   * @param grew called after a frame that may show more points than the one before
   */
  constructor(map: OlMap, { moved, grew }: Readonly<Record<"moved" | "grew", () => void>>) {
    this.map = map;
    this.#moved = moved;
    const follow = () => {
      this.#wanted = undefined;
      this.#apart = false;
      this.#follow();
      moved();
    };
    const drawn = () => {
      const loading = this.#layers.some((layer) => layer.hasRenderer() && !layer.getRenderer()?.ready);
      if (loading || this.#loading) grew();
      this.#loading = loading;
    };
    this.#keys = [map.on("change:view", follow), map.on("postrender", drawn)];
    this.#follow();
    this.know();
  }

  /** The view as it is; undefined where the map has none yet. */
  get view(): MapView | undefined {
    const view = this.map.getView();
    const center = view.getCenter();
    const resolution = view.getResolution();
    if (!view.isDef() || !center || !resolution) return undefined;
    return { center: [center[0], center[1]], resolution, rotation: view.getRotation() };
  }

  /**
   * The view as it is wanted. A map may be kept from showing what it is asked to: turned by 2°, at a resolution between two
   * levels, beyond its extent. What of that nobody has changed since is still wanted; what was changed is as the map has it.
   */
  get wanted(): MapView | undefined {
    const { view } = this;
    const [known, wanted] = [this.#known, this.#wanted];
    if (!view || !known || !wanted) return view;
    const choose = (now: number, before: number, then: number) => (now === before ? then : now);
    const along = (axis: 0 | 1) => {
      if (this.#apart) return wanted.center[axis] + view.center[axis] - known.center[axis];
      return choose(view.center[axis], known.center[axis], wanted.center[axis]);
    };
    return {
      center: [along(0), along(1)],
      resolution: choose(view.resolution, known.resolution, wanted.resolution),
      rotation: choose(view.rotation, known.rotation, wanted.rotation),
    };
  }

  /** Whether the view is another than the one known. */
  get hasMoved(): boolean {
    const { view } = this;
    if (!view) return false;
    const known = this.#known;
    return !(
      known &&
      view.center[0] === known.center[0] &&
      view.center[1] === known.center[1] &&
      view.resolution === known.resolution &&
      view.rotation === known.rotation
    );
  }

  /** Shows another view, as far as the map allows it; that is no move of the map's own. */
  show({ center, resolution, rotation }: MapView, turns: boolean): void {
    const view = this.map.getView();
    if (view.getAnimating()) view.cancelAnimations();
    view.setCenter([...center]);
    view.setResolution(resolution);
    if (turns) view.setRotation(rotation);
    this.#known = this.view;
    this.#wanted = { center, resolution, rotation: turns ? rotation : view.getRotation() };
    this.#apart = false;
  }

  /** Stands still while another view is what the user wants of the globe: moves of the map go on from that one. */
  stayBeside(wanted: MapView): void {
    this.#known = this.view;
    this.#wanted = wanted;
    this.#apart = true;
  }

  /** Moves the middle to a place, which is a move of the map's own. @param seconds 0: at once */
  flyTo(place: Vector, seconds: number): void {
    const coordinate = this.coordinateOf(place);
    if (coordinate) this.map.getView().animate({ center: [...coordinate], duration: 1000 * seconds });
  }

  /** Whether an interaction of the map draws figures: each that can finish a drawing and is active. */
  get drawing(): boolean {
    return this.map
      .getInteractions()
      .getArray()
      .some((one) => one.getActive() && "finishDrawing" in one);
  }

  /** Takes the view as it is for known. */
  know(): void {
    this.#wanted = this.wanted;
    this.#known = this.view;
  }

  /** The plane of the map's projection. */
  get plane(): Plane {
    const projection = this.map.getView().getProjection();
    const code = projection.getCode();
    if (this.#plane?.code !== code) {
      this.#plane = {
        code,
        plane: planeOf(code, projection.canWrapX() ? projection.getExtent() : undefined),
      };
    }
    return this.#plane.plane;
  }

  /** Greatest latitude that the map's projection shows, radians. */
  get edge(): number | undefined {
    const world = this.map.getView().getProjection().getWorldExtent();
    return world && (Math.min(-world[1], world[3]) * DEGREE || undefined);
  }

  /**
   * The place of the point that the map shows nearest to a pixel, the highest of several layers, as it is recorded: ECEF.
   * @param pixel CSS pixels from the upper left
   * @throws SourceError, DecodeError where the record cannot be read again; the signal's reason when aborted
   */
  async pick(pixel: readonly [number, number], signal: AbortSignal): Promise<Vector | undefined> {
    const hits = await Promise.all(this.#layers.map((layer) => layer.pick(pixel, { signal })));
    const places = hits.flatMap((hit): Vector[] => {
      if (!hit) return [];
      const [x, y, z] = hit.cloud.place(...hit.source);
      return [[x, y, z]];
    });
    return places.sort((a, b) => heightOf(b) - heightOf(a))[0];
  }

  /**
   * The place that the map shows at a pixel: of a point, else of the ground.
   * @param height of the ground there above WGS 84, metres
   * @throws as {@link pick}
   */
  async placeAt(
    pixel: readonly [number, number],
    height: number,
    signal: AbortSignal,
  ): Promise<Vector | undefined> {
    const coordinate = this.map.getCoordinateFromPixel([...pixel]);
    const point = await this.pick(pixel, signal);
    return point ?? (coordinate && placeOn(this.plane, coordinate, height));
  }

  /** Where a place of ECEF is on the map, in the world that it shows; undefined where it has none. */
  coordinateOf(place: Vector): readonly [number, number] | undefined {
    const [longitude, latitude] = geodeticOf(place);
    const { plane } = this;
    const [x, y] = plane.forward(longitude, latitude);
    if (!Number.isFinite(x) || !Number.isFinite(y)) return undefined;
    const near = this.view?.center[0] ?? x;
    return [near + unwrapped(x - near, plane.worldWidth), y];
  }

  dispose(): void {
    unByKey(this.#keys);
    if (this.#viewKey) unByKey(this.#viewKey);
  }

  /** Layers of points that are shown. */
  get #layers(): PointCloudLayer[] {
    return this.map
      .getAllLayers()
      .filter((layer): layer is PointCloudLayer => layer instanceof PointCloudLayer && layer.getVisible());
  }

  #follow(): void {
    if (this.#viewKey) unByKey(this.#viewKey);
    this.#view = this.map.getView();
    this.#viewKey = this.#view.on(["change:center", "change:resolution", "change:rotation"] as never, () =>
      this.#moved(),
    );
  }
}

/** @param world extent of the world, where it repeats */
function planeOf(code: string, world: Extent | undefined): Plane {
  const degrees = projectionOf("EPSG:4326")?.getCode() ?? "EPSG:4326";
  const forward = getTransform(degrees, code);
  const inverse = getTransform(code, degrees);
  const input = [0, 0];
  const convert = (of: typeof forward, x: number, y: number): readonly [number, number] => {
    input[0] = x;
    input[1] = y;
    try {
      const [first, second] = of(input, undefined, 2);
      return [first, second];
    } catch {
      // proj4 throws for what is no place of a projection.
      return NOWHERE;
    }
  };
  return {
    worldWidth: world && world[2] - world[0],
    limits: world && [world[1], world[3]],
    forward: (longitude, latitude) => convert(forward, longitude / DEGREE, latitude / DEGREE),
    inverse(x, y) {
      const [longitude, latitude] = convert(inverse, x, y);
      return [longitude * DEGREE, latitude * DEGREE];
    },
  };
}

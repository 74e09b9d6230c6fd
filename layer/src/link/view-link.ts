import type { Vector } from "@groma/georef";
import { heightOf } from "../camera/index.js";
import { toGroundView, toMapView } from "./geometry/index.js";
import type { GlobeSide } from "./globe-side.js";
import type { MapSide } from "./map-side.js";

/** Which view follows which. */
export type ViewMode = "both" | "to-map" | "to-globe" | "none";

/** Who moved a view: the user or the application on that side, or the link's own handles and clicks. */
export type MoveOrigin = "globe" | "map" | "handle";

/** A move that was carried over. */
export interface Move {
  readonly origin: MoveOrigin;
  /** The side that was moved by it. */
  readonly target: "globe" | "map";
}

/** What is done when nothing moves. @param grew whether more of terrain or points is there than the time before */
type RestWork = (grew: boolean) => Promise<void>;

/** Milliseconds without a move after which the height of what is looked at is read from the points. */
const REST = 150;
/** What is found no longer counts. */
const MOVED = "moved";
/** Pixels by which that height has to differ from the one held for the views to be moved again. */
const WORTH = 0.1;
/** Share by which their scales have to differ for that. */
const SCALE_WORTH = 1e-3;

/**
 * Carries the view of one side over to the other, once a frame at most. What it has moved itself it takes for known, so
 * that nothing comes back.
 */
export class ViewLink {
  mode: ViewMode;
  /** Whether both sides keep their own turn. */
  northUp: boolean;
  readonly #globe: GlobeSide;
  readonly #map: MapSide;
  #held = false;
  readonly #told: (move: Move | undefined) => void;
  readonly #failed: (thrown: unknown) => void;
  #frame: number | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #looking: AbortController | undefined;
  /** What is done at rest, and again once more of terrain and points is there. */
  #work: RestWork = (grew) => this.#readAhead(grew);
  /** Whether more of them is there than when that was done last. */
  #grown = false;

  /**
   * @param told called after each move that was carried over, and with undefined for one of the globe that was not
   * @param failed called with what kept a record from being read
   */
  constructor(
    globe: GlobeSide,
    map: MapSide,
    { mode, northUp }: { readonly mode: ViewMode; readonly northUp: boolean },
    told: (move: Move | undefined) => void,
    failed: (thrown: unknown) => void,
  ) {
    this.#globe = globe;
    this.#map = map;
    this.mode = mode;
    this.northUp = northUp;
    this.#told = told;
    this.#failed = failed;
  }

  /** The globe's camera is another. */
  globeMoved(): void {
    this.#globe.know();
    this.#cancelFrame();
    this.#showOnMap("globe");
    this.#atRest((grew) => this.#readAhead(grew));
  }

  /** There is more of the globe's terrain, or of the points on either side, to see than before. */
  grew(): void {
    this.#grown = true;
    if (this.#timer === undefined && !this.#looking) this.#atRest(this.#work);
  }

  /** The map's view may be another; it is looked at in the next frame, however often this is called before. */
  mapMoved(): void {
    if (!this.#globe.lives) return;
    if (this.#frame !== undefined || !this.#map.hasMoved) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = undefined;
      if (!this.#map.hasMoved) return;
      this.#map.know();
      if (this.#showOnGlobe("map")) return;
      // A map that goes its own way is not to be taken back when the globe's height is read.
      this.#cancelRest();
      this.#work = async () => this.#told(undefined);
      // What is drawn on the map may have to follow to another projection.
      this.#told(undefined);
    });
  }

  /**
   * Has the map stand still whatever the globe does, while what is on it is dragged. Afterwards the globe is where that has left
   * it, and goes on from there when the map is moved.
   */
  hold(held: boolean): void {
    this.#held = held;
    const [globe, map] = [this.#globe, this.#map];
    const view = held || !globe.shown ? undefined : toMapView(map.plane, globe.view, map.view?.center[0]);
    if (view) map.stayBeside(view);
  }

  /** Carries the view over as it is, in the direction of the mode; the globe's where both are possible. */
  carry(): void {
    if (this.mode === "to-globe") this.#showOnGlobe("map");
    else this.#showOnMap("globe");
    this.#atRest((grew) => (this.mode === "to-globe" ? this.#readBelow(grew) : this.#readAhead(grew)));
  }

  dispose(): void {
    this.#cancelFrame();
    this.#cancelRest();
    this.#grown = false;
  }

  #showOnMap(origin: MoveOrigin): void {
    const [globe, map] = [this.#globe, this.#map];
    const before = map.view;
    const follows = this.mode === "both" || this.mode === "to-map";
    const view =
      follows && !this.#held && globe.shown ? toMapView(map.plane, globe.view, before?.center[0]) : undefined;
    if (view) map.show(view, !this.northUp);
    this.#told(view && { origin, target: "map" });
  }

  #showOnGlobe(origin: MoveOrigin, height?: number): boolean {
    const [globe, map] = [this.#globe, this.#map];
    const view = map.wanted;
    if (!view || !globe.shown || (this.mode !== "both" && this.mode !== "to-globe")) return false;
    const [longitude, latitude] = map.plane.inverse(...view.center);
    const ground = toGroundView(map.plane, view, height ?? globe.heightAt(longitude, latitude));
    if (!ground) return false;
    globe.show(ground, !this.northUp);
    this.#told({ origin, target: "globe" });
    if (height === undefined) this.#atRest((grew) => this.#readBelow(grew));
    return true;
  }

  /** The point in the middle of the globe's picture says how high lies what the camera looks at. */
  async #readAhead(grew: boolean): Promise<void> {
    const globe = this.#globe;
    const found = await this.#look((signal) => globe.pick(globe.middle, signal));
    if (found === MOVED) return;
    const height = found ? heightOf(found) : globe.guess();
    if ((height !== undefined && this.#differs(height)) || this.#isOff()) this.#showOnMap("globe");
    else if (grew) this.#told(undefined);
  }

  /** Whether the map shows another view than the globe does, now that more of its terrain is there. */
  #isOff(): boolean {
    const [globe, map] = [this.#globe, this.#map];
    const shown = map.wanted;
    const view = shown && toMapView(map.plane, globe.view, shown.center[0]);
    if (!view) return false;
    const away = Math.hypot(view.center[0] - shown.center[0], view.center[1] - shown.center[1]);
    return away > WORTH * view.resolution || Math.abs(view.resolution / shown.resolution - 1) > SCALE_WORTH;
  }

  /** The point in the middle of the map says how high lies what it shows there. */
  async #readBelow(grew: boolean): Promise<void> {
    const [globe, map] = [this.#globe, this.#map];
    const [width, height] = map.map.getSize() ?? [0, 0];
    const found = await this.#look((signal) => map.pick([width / 2, height / 2], signal));
    if (found === MOVED) return;
    const [longitude, latitude] = map.plane.inverse(...(map.view?.center ?? [0, 0]));
    const ground = found ? heightOf(found) : globe.heightAt(longitude, latitude);
    if (this.#differs(ground)) this.#showOnGlobe("map", globe.height);
    else if (grew) this.#told(undefined);
  }

  /** Takes over a height of what is looked at. @returns whether the views would show it */
  #differs(height: number): boolean {
    const globe = this.#globe;
    const differs = Math.abs(height - globe.height) > WORTH * globe.view.metresPerPixel;
    globe.height = height;
    return differs;
  }

  /** What a pick finds, unless anything moved meanwhile. */
  async #look(
    pick: (signal: AbortSignal) => Promise<Vector | undefined>,
  ): Promise<Vector | undefined | typeof MOVED> {
    const looking = new AbortController();
    this.#looking = looking;
    try {
      const found = await pick(looking.signal);
      // A move that is not carried over yet comes first.
      const moved = looking.signal.aborted || this.#map.hasMoved || this.#globe.hasMoved;
      return moved ? MOVED : found;
    } catch (thrown) {
      if (!looking.signal.aborted) this.#failed(thrown);
      return MOVED;
    } finally {
      if (this.#looking === looking) this.#looking = undefined;
    }
  }

  #atRest(work: RestWork): void {
    this.#cancelRest();
    this.#work = work;
    this.#timer = setTimeout(async () => {
      this.#timer = undefined;
      if (!this.#globe.lives) return;
      const grew = this.#grown;
      this.#grown = false;
      await work(grew);
      if (this.#grown) this.grew();
    }, REST);
  }

  #cancelRest(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#looking?.abort();
  }

  #cancelFrame(): void {
    if (this.#frame !== undefined) cancelAnimationFrame(this.#frame);
    this.#frame = undefined;
  }
}

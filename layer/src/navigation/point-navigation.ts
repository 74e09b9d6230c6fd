import { difference, type Vector } from "@groma/georef";
import { Cartesian3, DeveloperError, Event, type Scene } from "cesium";
import { type CameraPose, headingAt, type ScreenPlace, upAt } from "../camera/index.js";
import { layersIn, vectorOf } from "../cesium/scene-camera.js";
import { Anchors } from "./anchors.js";
import { CameraHold } from "./camera-hold.js";
import { dragOn, type Held, heldBy } from "./drags.js";
import { Glides } from "./glides.js";
import { HeldKeys, type KeyDeed, type Rates } from "./keys.js";
import { carried, orbit, pitchOf, step } from "./motions/index.js";
import { Mover } from "./mover.js";
import {
  checkFlight,
  checkNavigation,
  checkSetting,
  type FlightOptions,
  type NavigatedLayer,
  type NavigatedViewer,
  type NavigationMode,
  type NavigationOptions,
  type NavigationSettings,
} from "./options.js";
import { type Drag, Pointers } from "./pointers.js";
import { reducedMotion } from "./reduced-motion.js";

/** Milliseconds after which keys look anew for how far away what is ahead is. */
const LOOK_AHEAD = 300;
/** Share of a change of that distance that a frame takes over. */
const SETTLING = 0.1;
/** Keys turn and tilt by so many radians a second, come nearer by e to the power of this, and are so many times as fast. */
const KEYS = { turn: 1, tilt: 0.7, zoom: 1.2, fast: 4 };
/** Longest time that counts as one frame, seconds: after a pause nothing rushes off. */
const FRAME = 0.1;
/** Share of its distance to which a double click brings the camera. */
const NEARER = 1 / 3;

/**
 * Moves the camera of a Cesium scene about the points in it, by mouse, touch and keyboard.
 *
 * What is under the pointer when it is pressed is the point drawn there, else the terrain or the ellipsoid; it stays under
 * the pointer when it is dragged, and in its place of the picture when it is orbited and approached. Cesium's own
 * navigation rests meanwhile, except in 2D, in Columbus view, and where the camera tracks something.
 */
export class PointNavigation {
  /** Raised with the mode when it becomes another, by a key too. */
  readonly modeChanged = new Event<(mode: NavigationMode) => void>();

  readonly #scene: Scene;
  readonly #settings: NavigationSettings;
  readonly #layers: () => readonly NavigatedLayer[];
  readonly #anchors: Anchors;
  readonly #hold: CameraHold;
  readonly #mover: Mover;
  readonly #glides = new Glides();
  readonly #pointers: Pointers;
  readonly #keys: HeldKeys;
  readonly #end = new AbortController();
  readonly #unwatch: () => void;
  #held: Held | undefined;
  #time = 0;
  /** What keys move about, its distance in metres as it makes their speed, and when it was looked for. */
  #pivot: Vector | undefined;
  #ahead = 1;
  #looked = 0;
  #destroyed = false;

  /** @throws StyleError STYLE_OPTION */
  constructor(viewer: NavigatedViewer, options: NavigationOptions = {}) {
    const { scene, settings, layers } = checkNavigation(viewer, options);
    this.#scene = scene;
    this.#settings = { ...settings };
    this.#layers = layers ?? (() => layersIn(scene.primitives));
    this.#anchors = new Anchors(scene, this.#layers);
    this.#hold = new CameraHold(scene);
    this.#mover = new Mover(scene, this.#settings, this.#layers);
    const { canvas } = scene;
    if (canvas.tabIndex < 0) canvas.tabIndex = 0;
    // Else the browser takes fingers for a scroll of the page.
    canvas.style.touchAction = "none";
    this.#pointers = new Pointers(canvas, {
      began: (drag) => this.#take(drag),
      ended: () => {
        if (this.#held) this.#held.over = true;
      },
      wheel: (at, nearer) => this.#turnWheel(at, nearer),
      doubled: (at) => void this.#flyToPicked(at),
    });
    this.#keys = new HeldKeys(canvas, () => (this.#hold.held ? this.mode : undefined), {
      began: () => this.#beginKeys(),
      deed: (deed) => this.#do(deed),
    });
    this.#hold.update(this.enabled, this.lookUnder);
    this.#unwatch = scene.preUpdate.addEventListener(() => this.#update());
  }

  /** Whether the navigation has the camera; Cesium's own has it otherwise. @throws StyleError STYLE_OPTION */
  get enabled(): boolean {
    return this.#settings.enabled;
  }

  set enabled(enabled: boolean) {
    this.#set("enabled", enabled);
    if (!enabled) this.#rest();
    this.#hold.update(enabled, this.lookUnder);
  }

  /** What pointer and keys do. @throws StyleError STYLE_OPTION */
  get mode(): NavigationMode {
    return this.#settings.mode;
  }

  set mode(mode: NavigationMode) {
    const before = this.mode;
    this.#set("mode", mode);
    if (mode === before) return;
    this.#rest();
    this.modeChanged.raiseEvent(mode);
  }

  /** What the left button and one finger do in `orbit`. @throws StyleError STYLE_OPTION */
  get drag(): NavigationSettings["drag"] {
    return this.#settings.drag;
  }

  set drag(drag: NavigationSettings["drag"]) {
    this.#set("drag", drag);
  }

  /** Whether a double click flies to the point there. @throws StyleError STYLE_OPTION */
  get doubleClick(): boolean {
    return this.#settings.doubleClick;
  }

  set doubleClick(doubleClick: boolean) {
    this.#set("doubleClick", doubleClick);
  }

  /** Whether the camera may go below the ground and look up. @throws StyleError STYLE_OPTION */
  get lookUnder(): boolean {
    return this.#settings.lookUnder;
  }

  set lookUnder(lookUnder: boolean) {
    this.#set("lookUnder", lookUnder);
    this.#hold.update(this.enabled, lookUnder);
  }

  /** Metres by which the camera keeps away from points that are drawn; 0: not at all. @throws StyleError STYLE_OPTION */
  get collision(): number {
    return this.#settings.collision;
  }

  set collision(metres: number) {
    this.#set("collision", metres);
  }

  /** Speed of keys, in distances to what is ahead per second. @throws StyleError STYLE_OPTION */
  get speed(): number {
    return this.#settings.speed;
  }

  set speed(speed: number) {
    this.#set("speed", speed);
  }

  /** Seconds of a flight. @throws StyleError STYLE_OPTION */
  get flight(): number {
    return this.#settings.flight;
  }

  set flight(seconds: number) {
    this.#set("flight", seconds);
  }

  /** Turns the camera about what it looks at until north is up. */
  northUp(): void {
    this.#mustExist();
    this.#turnAboutMiddle((pose, pivot) => ({ turn: headingAt(pose, pivot), tilt: 0 }));
  }

  /** Turns the camera about what it looks at until it looks straight down. */
  lookDown(): void {
    this.#mustExist();
    this.#turnAboutMiddle((pose, pivot) => ({ turn: 0, tilt: -Math.PI / 2 - pitchOf(pose, upAt(pivot)) }));
  }

  /**
   * Flies to where a place is in the middle of the picture, seen from the side from which the camera looks now.
   * @param place ECEF, metres
   * @returns whether the camera has arrived; not where it was sent elsewhere meanwhile
   * @throws StyleError STYLE_OPTION
   */
  flyTo(place: Cartesian3, options: FlightOptions = {}): Promise<boolean> {
    this.#mustExist();
    const { distance, duration } = checkFlight(place, options);
    this.#rest();
    const { camera, screenSpaceCameraController: limits } = this.#scene;
    const { pose } = this.#mover;
    const to = vectorOf(place);
    const away = distance ?? NEARER * Math.hypot(...difference(to, pose.position));
    const { direction, up } = carried(pose, pose.position, to);
    const range = Math.max(away, limits.minimumZoomDistance);
    const stand = new Cartesian3(...([0, 1, 2] as const).map((at) => to[at] - range * direction[at]));
    this.#anchors.found(to);
    const seconds = reducedMotion() ? 0 : (duration ?? this.flight);
    return new Promise((resolve) => {
      camera.flyTo({
        ...{
          destination: stand,
          orientation: { direction: new Cartesian3(...direction), up: new Cartesian3(...up) },
        },
        ...{ duration: seconds, complete: () => resolve(true), cancel: () => resolve(false) },
      });
      this.#scene.requestRender();
    });
  }

  isDestroyed(): boolean {
    return this.#destroyed;
  }

  /** Ends it, and gives the camera back to Cesium's own navigation. Called again it does nothing. */
  destroy(): undefined {
    if (this.#destroyed) return undefined;
    this.#destroyed = true;
    this.#end.abort();
    this.#unwatch();
    this.#rest();
    this.#pointers.destroy();
    this.#keys.destroy();
    this.#hold.release();
    return undefined;
  }

  /** @throws DeveloperError after `destroy()`, in the words of Cesium's own objects */
  #mustExist(): void {
    if (this.#destroyed) throw new DeveloperError("This object was destroyed, i.e., destroy() was called.");
  }

  #set<Name extends keyof NavigationSettings>(name: Name, value: NavigationSettings[Name]): void {
    this.#mustExist();
    this.#settings[name] = checkSetting(name, value);
  }

  /** Nothing that was begun goes on. */
  #rest(): void {
    this.#pointers.drop();
    this.#held = undefined;
    this.#keys.release();
    this.#glides.stop();
  }

  /** A drag begins: it moves the camera as soon as its place is found. */
  #take(drag: Drag): void {
    if (!this.#hold.take()) {
      this.#pointers.drop();
      return;
    }
    this.#glides.stop();
    const held = heldBy(drag, this.mode, this.drag);
    this.#held = held;
    // What looks around needs no place.
    if (held.way !== "look") {
      this.#find(drag.start, (place) => {
        held.place = place;
      });
    }
  }

  #turnWheel(at: ScreenPlace, nearer: number): void {
    if (!this.#hold.take()) return;
    const found = this.#glides.turnWheel(at, nearer);
    if (found) this.#find(at, found);
    else this.#scene.requestRender();
  }

  async #flyToPicked(at: ScreenPlace): Promise<void> {
    if (!this.doubleClick || !this.#hold.take()) return;
    const place = await this.#anchors.find(at, this.#end.signal);
    if (!this.#end.signal.aborted) await this.flyTo(new Cartesian3(...place));
  }

  #find(at: ScreenPlace, found: (place: Vector) => void): void {
    const { signal } = this.#end;
    void this.#anchors.find(at, signal).then((place) => {
      if (signal.aborted) return;
      found(place);
      this.#scene.requestRender();
    });
  }

  #middle(): ScreenPlace {
    const { clientWidth, clientHeight } = this.#scene.canvas;
    return { x: clientWidth / 2, y: clientHeight / 2 };
  }

  #beginKeys(): void {
    if (!this.#hold.take()) return;
    this.#glides.stop();
    this.#pivot = this.#anchors.guess(this.#middle());
    this.#ahead = this.#anchors.reach;
    this.#lookAhead();
    this.#scene.requestRender();
  }

  /** Keys move about what is in the middle of the picture. */
  #lookAhead(): void {
    this.#looked = performance.now();
    this.#find(this.#middle(), (place) => {
      this.#pivot = place;
    });
  }

  #do(deed: KeyDeed): void {
    if (deed === "north") this.northUp();
    else if (deed === "down") this.lookDown();
    else if (deed === "mode") this.mode = this.mode === "walk" ? "orbit" : "walk";
    else {
      this.#rest();
      this.#scene.camera.cancelFlight();
    }
  }

  #turnAboutMiddle(wanted: (pose: CameraPose, pivot: Vector) => { turn: number; tilt: number }): void {
    this.#rest();
    if (!this.#hold.take()) return;
    this.#find(this.#middle(), (middle) => {
      const { pose } = this.#mover;
      const pivot = this.mode === "walk" ? pose.position : middle;
      const { turn, tilt } = wanted(pose, pivot);
      this.#glides.begin(pivot, turn, tilt);
    });
  }

  /** Once a frame, before the scene looks at its camera. */
  #update(): void {
    const now = performance.now();
    const seconds = Math.min(FRAME, (now - this.#time) / 1000);
    this.#time = now;
    this.#hold.update(this.enabled, this.lookUnder);
    if (!this.#hold.held || !(this.#held || this.#keys.any || this.#glides.any)) return;
    if (!this.#scene.screenSpaceCameraController.enableInputs) {
      this.#rest();
      return;
    }
    const mover = this.#mover;
    const before = mover.pose;
    let pose = this.#held ? dragOn(before, this.#held, mover) : before;
    if (this.#held?.over && (this.#held.place || this.#held.way === "look")) this.#held = undefined;
    if (this.#keys.any) pose = this.#move(pose, this.#keys.take(seconds), now);
    mover.show(before, this.#glides.goOn(pose, seconds, mover));
    if (this.#keys.any || this.#glides.any) this.#scene.requestRender();
  }

  /** By keys: as far in a second as what is ahead is away, or a part of it. */
  #move(pose: CameraPose, rates: Rates, now: number): CameraPose {
    const { ahead, aside, up } = rates;
    if ((ahead || aside || up) && now - this.#looked > LOOK_AHEAD) this.#lookAhead();
    const place = this.#pivot ?? pose.position;
    // Little by little, so that the speed does not jump where something else comes into sight.
    this.#ahead += SETTLING * (Math.hypot(...difference(place, pose.position)) - this.#ahead);
    const speed = this.speed * this.#ahead * (rates.fast ? KEYS.fast : 1);
    const moved = step(pose, { ahead: speed * ahead, aside: speed * aside, up: speed * up });
    const mover = this.#mover;
    const pivot = this.mode === "walk" ? moved.position : place;
    const [turn, tilt] = [KEYS.turn * rates.turn, KEYS.tilt * rates.tilt];
    const turned = orbit(moved, pivot, turn, tilt, mover.pitches(pivot, moved));
    return mover.zoom(turned, place, Math.exp(-KEYS.zoom * rates.zoom));
  }
}

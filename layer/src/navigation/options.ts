import type { Vector } from "@groma/georef";
import { type BoundingSphere, Cartesian3, type Scene } from "cesium";
import type { ScreenPlace } from "../camera/index.js";
import {
  above,
  flag,
  type Kinds,
  kindOf,
  list,
  number,
  oneOf,
  optionPlace,
  parts,
  some,
  withMethods,
} from "../options/index.js";

/** What the pointer and the keys do: move about a place, or through the scene as on foot. */
export type NavigationMode = "orbit" | "walk";

/** How a reader moves about; each can be assigned later. */
export interface NavigationSettings {
  /** Whether the navigation has the camera; Cesium's own has it otherwise. Default: true. */
  enabled: boolean;
  /** Default: `orbit`. */
  mode: NavigationMode;
  /** What the left button and one finger do in `orbit`; the right button does the other. Default: `pan`. */
  drag: "pan" | "orbit";
  /** Whether a double click flies to the point there. Default: true. */
  doubleClick: boolean;
  /** Whether the camera may go below the ground and look up; where not, Cesium keeps it above. Default: true. */
  lookUnder: boolean;
  /** Metres by which the camera keeps away from points that are drawn; 0: it passes between them. Default: 0. */
  collision: number;
  /** Speed of keys, in distances to what is ahead per second. Default: 0.7. */
  speed: number;
  /** Seconds of a flight; readers who asked for less motion are there at once. Default: 1.2. */
  flight: number;
}

/** What a navigation needs of a layer of points: a `PointCloudLayer` has it. */
export interface NavigatedLayer {
  readonly boundingSphere: BoundingSphere;
  /** Where the point drawn nearest to a place of the canvas is drawn, ECEF. */
  pickPosition(
    windowPosition: ScreenPlace,
    options?: { readonly window?: number; readonly signal?: AbortSignal },
  ): Promise<Cartesian3 | undefined>;
  /** Where points drawn lately lie within some metres of a place: x, y, z of each, ECEF. @internal */
  drawnNear(place: Vector, radius: number): readonly number[];
}

/** How a navigation begins. */
export interface NavigationOptions extends Partial<NavigationSettings> {
  /** Layers whose points are moved about, asked for anew each time. Default: all that the scene shows. */
  readonly layers?: (() => readonly NavigatedLayer[]) | undefined;
}

/** What a navigation moves the camera of: a `Viewer` or a `CesiumWidget` of Cesium. */
export interface NavigatedViewer {
  readonly scene: Scene;
}

/** How a flight ends. */
export interface FlightOptions {
  /** Metres from the place at its end. Default: a third of what they are now. */
  readonly distance?: number | undefined;
  /** Seconds; 0: at once. Default: the navigation's `flight`. */
  readonly duration?: number | undefined;
}

type Layers = NavigationOptions["layers"];

const SETTINGS: Kinds<NavigationSettings> = {
  enabled: flag,
  mode: oneOf("orbit", "walk"),
  drag: oneOf("pan", "orbit"),
  doubleClick: flag,
  lookUnder: flag,
  collision: number(0, 1000),
  speed: number(0.01, 100),
  flight: number(0, 60),
};

const KINDS: Kinds<NavigationSettings & { readonly layers: Layers }> = {
  ...SETTINGS,
  layers: kindOf(
    "a function",
    (given): given is Layers => given === undefined || typeof given === "function",
  ),
};

const DEFAULTS: NavigationSettings = {
  ...{ enabled: true, mode: "orbit", drag: "pan", doubleClick: true },
  ...{ lookUnder: true, collision: 0, speed: 0.7, flight: 1.2 },
};

const VIEWER = kindOf("a Viewer of Cesium", (given): given is NavigatedViewer => {
  const { scene } = (given ?? {}) as { scene?: { camera?: unknown; screenSpaceCameraController?: unknown } };
  return (
    typeof scene === "object" &&
    scene?.camera !== undefined &&
    scene.screenSpaceCameraController !== undefined
  );
});

const LAYERS = list(withMethods<NavigatedLayer>("a PointCloudLayer", "pickPosition", "drawnNear"));

const PLACE = "PointNavigation";

/** Viewer and options, those by default among them. @throws StyleError STYLE_OPTION */
export function checkNavigation(viewer: NavigatedViewer, options: NavigationOptions) {
  const { scene } = VIEWER.read(viewer, optionPlace("viewer", PLACE));
  const { layers, ...settings } = parts(KINDS, DEFAULTS).read(options, optionPlace("options", PLACE));
  const checked = layers && (() => LAYERS.read(layers(), optionPlace("layers", PLACE)));
  return { scene, settings, layers: checked };
}

/** One of the settings, as it is assigned. @throws StyleError STYLE_OPTION */
export function checkSetting<Name extends keyof NavigationSettings>(
  name: Name,
  given: NavigationSettings[Name],
): NavigationSettings[Name] {
  return SETTINGS[name].read(given, optionPlace(name, PLACE)) as NavigationSettings[Name];
}

const FLIGHT = some<FlightOptions>({ distance: above(0), duration: number(0, 60) });
const ECEF = kindOf(
  "a Cartesian3 of finite numbers",
  (given): given is Cartesian3 =>
    given instanceof Cartesian3 && [given.x, given.y, given.z].every(Number.isFinite),
);

/** Where a flight goes, and how it ends. @throws StyleError STYLE_OPTION */
export function checkFlight(place: Cartesian3, options: FlightOptions): FlightOptions {
  ECEF.read(place, optionPlace("place", `${PLACE}.flyTo`));
  return FLIGHT.read(options, optionPlace("options", `${PLACE}.flyTo`));
}

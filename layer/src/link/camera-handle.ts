import type { Coordinate } from "ol/coordinate.js";
import Feature from "ol/Feature.js";
import Point from "ol/geom/Point.js";
import PointerInteraction from "ol/interaction/Pointer.js";
import VectorLayer from "ol/layer/Vector.js";
import VectorSource from "ol/source/Vector.js";
import Style from "ol/style/Style.js";
import { headingAt, moveCamera } from "../camera/index.js";
import { geodeticOf, placeOn, toGroundView, toMapView } from "./geometry/index.js";
import type { GlobeSide } from "./globe-side.js";
import { ACCENT } from "./looks.js";
import type { MapSide } from "./map-side.js";

/** CSS pixels from the camera's place to the grip that turns it. */
const ARM = 44;
/** Radii of the two grips as they are drawn, and within which a pointer takes hold of them, CSS pixels. */
const RADII = { stand: 7, tip: 5, reach: 14 };

/** What of the handle is held. */
type Grip = "stand" | "tip";

/**
 * The globe's camera on the map: a disc where it stands, to be dragged, and an arm in the direction in which it looks, whose
 * end turns it. Height, tilt and roll stay. The map stands still meanwhile.
 */
export class CameraHandle {
  readonly feature = new Feature<Point>();
  readonly #globe: GlobeSide;
  readonly #map: MapSide;
  readonly #layer: VectorLayer;
  readonly #interaction: PointerInteraction;
  /** Radians clockwise from the map's upward direction, before the view's turn. */
  #turn = 0;
  #held: Grip | undefined;

  /**
   * @param dragged called while it is dragged, after the camera has moved
   * @param holds called when the handle is taken hold of and let go
   */
  constructor(globe: GlobeSide, map: MapSide, dragged: () => void, holds: (held: boolean) => void) {
    this.#globe = globe;
    this.#map = map;
    this.#layer = new VectorLayer({
      source: new VectorSource({ features: [this.feature], wrapX: true }),
      style: new Style({ renderer: (at, state) => this.#draw(at as Coordinate, state) }),
      updateWhileAnimating: true,
      updateWhileInteracting: true,
    });
    this.#layer.setMap(map.map);
    this.#interaction = new PointerInteraction({
      handleDownEvent: ({ pixel }) => {
        this.#held = globe.lives ? this.#gripAt(pixel) : undefined;
        if (this.#held) holds(true);
        return this.#held !== undefined;
      },
      handleDragEvent: ({ coordinate }) => {
        if (globe.lives && this.#drag(coordinate)) dragged();
      },
      handleUpEvent: () => {
        this.#held = undefined;
        holds(false);
        return false;
      },
      handleMoveEvent: ({ pixel, dragging }) => {
        if (!dragging) this.#showCursor(this.#gripAt(pixel));
      },
    });
    map.map.addInteraction(this.#interaction);
    this.update();
  }

  /** Shows the camera where it is now. */
  update(): void {
    const { plane, view } = this.#map;
    const pose = this.#globe.shown ? this.#globe.pose : undefined;
    const ground = pose && {
      ...{ place: pose.position, heading: headingAt(pose, pose.position), metresPerPixel: 1 },
    };
    const found = ground && toMapView(plane, ground, view?.center[0]);
    this.#turn = -(found?.rotation ?? 0);
    this.feature.setGeometry(found && new Point([...found.center]));
    // The arm alone may have turned.
    this.feature.changed();
  }

  dispose(): void {
    this.#showCursor(undefined);
    this.#map.map.removeInteraction(this.#interaction);
    this.#layer.setMap(null);
    this.#layer.dispose();
  }

  /** Moves or turns the camera as the grip that is held says. @returns whether it could be */
  #drag(coordinate: Coordinate): boolean {
    const [globe, map] = [this.#globe, this.#map];
    const { pose } = globe;
    const heading = headingAt(pose, pose.position);
    const from = { place: pose.position, heading };
    const [, , height] = geodeticOf(pose.position);
    if (this.#held === "stand") {
      const place = placeOn(map.plane, coordinate, height);
      if (!place) return false;
      globe.stand(moveCamera(pose, from, { place, heading }, 1));
      return true;
    }
    const stand = this.feature.getGeometry()?.getCoordinates();
    if (!stand) return false;
    const [dx, dy] = [coordinate[0] - stand[0], coordinate[1] - stand[1]];
    const view = { center: [stand[0], stand[1]] as const, resolution: 1, rotation: -Math.atan2(dx, dy) };
    const ground = toGroundView(map.plane, view, height);
    if (!ground || (dx === 0 && dy === 0)) return false;
    globe.stand(moveCamera(pose, from, { place: pose.position, heading: ground.heading }, 1));
    return true;
  }

  #gripAt([x, y]: readonly number[]): Grip | undefined {
    const { map } = this.#map;
    const stand = this.feature.getGeometry()?.getCoordinates();
    if (!stand) return undefined;
    // Where the world repeats, the camera can be taken hold of in each that shows.
    const { worldWidth } = this.#map.plane;
    const center = map.getView().getCenter() ?? stand;
    const worlds = worldWidth
      ? [-1, 0, 1].map((turn) => Math.round((center[0] - stand[0]) / worldWidth) + turn)
      : [0];
    const angle = this.#turn + map.getView().getRotation();
    for (const world of worlds) {
      const pixel = map.getPixelFromCoordinate([stand[0] + world * (worldWidth ?? 0), stand[1]]);
      if (!pixel) continue;
      const tip = [pixel[0] + ARM * Math.sin(angle), pixel[1] - ARM * Math.cos(angle)];
      if (Math.hypot(x - tip[0], y - tip[1]) <= RADII.reach) return "tip";
      if (Math.hypot(x - pixel[0], y - pixel[1]) <= RADII.reach) return "stand";
    }
    return undefined;
  }

  #showCursor(grip: Grip | undefined): void {
    const { style } = this.#map.map.getViewport();
    const wanted = grip === "stand" ? "move" : grip === "tip" ? "grab" : "";
    if (style.cursor !== wanted && (wanted !== "" || ["move", "grab"].includes(style.cursor))) {
      style.cursor = wanted;
    }
  }

  #draw(
    [x, y]: Coordinate,
    { context, pixelRatio }: { context: CanvasRenderingContext2D; pixelRatio: number },
  ): void {
    const angle = this.#turn + (this.#map.view?.rotation ?? 0);
    const arm = ARM * pixelRatio;
    const [tipX, tipY] = [x + arm * Math.sin(angle), y - arm * Math.cos(angle)];
    const disc = (atX: number, atY: number, radius: number) => {
      context.beginPath();
      context.arc(atX, atY, radius * pixelRatio, 0, 2 * Math.PI);
      context.fillStyle = ACCENT;
      context.fill();
      context.stroke();
    };
    context.save();
    context.strokeStyle = "rgba(0, 0, 0, 0.7)";
    context.lineWidth = 4 * pixelRatio;
    for (const colour of ["rgba(0, 0, 0, 0.7)", ACCENT]) {
      context.strokeStyle = colour;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(tipX, tipY);
      context.stroke();
      context.lineWidth = 2 * pixelRatio;
    }
    context.strokeStyle = "rgba(0, 0, 0, 0.7)";
    context.lineWidth = 1.5 * pixelRatio;
    disc(x, y, RADII.stand);
    disc(tipX, tipY, RADII.tip);
    context.restore();
  }
}

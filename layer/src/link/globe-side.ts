import { difference, dot, type Vector } from "@groma/georef";
import {
  Cartesian2,
  Cartesian3,
  Cartographic,
  Ray as CesiumRay,
  EllipsoidTerrainProvider,
  IntersectionTests,
  OrthographicFrustum,
  type Scene,
  SceneMode,
} from "cesium";
import {
  type CameraPose,
  headingAt,
  heightOf,
  meetSurface,
  moveCamera,
  placeLookedAt,
  type Ray,
  rayThrough,
  type ScreenPlace,
} from "../camera/index.js";
import type { PointCloudLayer } from "../cesium/index.js";
import { layersIn, lensOf, poseOf, standCamera, vectorOf } from "../cesium/scene-camera.js";
import { footprintOf, type GroundView, geodeticOf } from "./geometry/index.js";

const scratch = { ray: new CesiumRay(), place: new Cartesian3(), cartographic: new Cartographic() };

/** Share of a number by which a scene may move its camera by its own rounding, as Cesium does: not a move of anybody's. */
const ROUNDING = 1e-12;

/** The globe as a link knows it: its camera, its ground, and the points on it. */
export class GlobeSide {
  readonly scene: Scene;
  /** Height above WGS 84 of what the camera looks at, as it was found last, metres. */
  #height = 0;
  /** Whether anything was found yet. */
  #found = false;
  /** The camera, as it was told last. */
  #known: readonly number[] = [];
  readonly #middle: (() => ScreenPlace) | undefined;
  readonly #moved: () => void;
  readonly #gone: () => void;
  readonly #unwatch: readonly (() => void)[];
  /** Whether points or terrain were still on their way when the last frame was drawn. */
  #loading = false;

  /**
   * @param middle place of the picture that counts as its middle, asked for anew each time; default: half of its size
   * @param moved called within a frame whose camera is another than the one known
   * @param grew called after a frame that may show more terrain or points than the one before
   * @param gone called when the globe is found to be destroyed
   */
  constructor(
    scene: Scene,
    middle: (() => ScreenPlace) | undefined,
    { moved, grew, gone }: Readonly<Record<"moved" | "grew" | "gone", () => void>>,
  ) {
    this.scene = scene;
    this.#middle = middle;
    this.#moved = moved;
    this.#gone = gone;
    this.#height = this.guess() ?? 0;
    this.#known = this.#numbers();
    this.#unwatch = [
      scene.preRender.addEventListener(() => this.look()),
      scene.postRender.addEventListener(() => {
        const loading = this.#loads;
        if (loading || this.#loading) grew();
        this.#loading = loading;
      }),
    ];
  }

  /** Tells where the camera is another than the one known. */
  look(): void {
    if (this.hasMoved && this.shown) this.#moved();
  }

  /** Whether there is a globe to work with; one that was destroyed, which Cesium tells nobody, is told of here. */
  get lives(): boolean {
    if (this.scene.isDestroyed()) this.#gone();
    return !this.scene.isDestroyed();
  }

  /** Whether the globe is drawn as a globe now, and has a size. */
  get shown(): boolean {
    if (!this.lives) return false;
    const { mode, canvas } = this.scene;
    return mode === SceneMode.SCENE3D && canvas.clientWidth > 0 && canvas.clientHeight > 0;
  }

  get pose(): CameraPose {
    return poseOf(this.scene.camera);
  }

  /** Place of the picture whose ground is in the middle of the map, CSS pixels from the upper left. */
  get middle(): ScreenPlace {
    const { clientWidth, clientHeight } = this.scene.canvas;
    return this.#middle?.() ?? { x: clientWidth / 2, y: clientHeight / 2 };
  }

  /** What the camera looks at. */
  get view(): GroundView {
    const { pose } = this;
    const lens = lensOf(this.scene);
    const { origin, direction } = rayThrough(pose, lens, this.middle);
    const place = this.#lookedAt({ ...pose, position: origin, direction });
    const { halves, height } = lens;
    const depth = halves.parallel ? 1 : distance(place, origin) * dot(direction, pose.direction);
    const metresPerPixel = (2 * depth * halves.up) / height;
    return { place, heading: headingAt(pose, place), metresPerPixel };
  }

  /** Height of the ground, or of what stands on it, at a place that is not looked at yet, metres above WGS 84. */
  heightAt(longitude: number, latitude: number): number {
    const terrain = this.#terrain?.getHeight(
      Cartographic.fromRadians(longitude, latitude, 0, scratch.cartographic),
    );
    return terrain ?? this.#height;
  }

  /** Height above WGS 84 of what is looked at, until something else is found. */
  get height(): number {
    return this.#height;
  }

  set height(metres: number) {
    this.#height = metres;
    this.#found = true;
  }

  /** Until anything is found, the height of the middle of the points ahead. */
  guess(): number | undefined {
    if (this.#found) return undefined;
    const { positionWC, directionWC } = this.scene.camera;
    const ray = new CesiumRay(positionWC, directionWC);
    const ahead = this.layers.find(({ boundingSphere }) => IntersectionTests.raySphere(ray, boundingSphere));
    return ahead && heightOf(vectorOf(ahead.boundingSphere.center));
  }

  /** Whether points or terrain of the view are still on their way. */
  get #loads(): boolean {
    return this.#terrain?.tilesLoaded === false || this.layers.some(({ settled }) => !settled);
  }

  /** Has the camera look at another place in the way in which it looks now. @param turns whether its heading changes */
  show(ground: GroundView, turns: boolean): void {
    const now = this.view;
    const from = { place: now.place, heading: now.heading };
    const to = { place: ground.place, heading: turns ? ground.heading : now.heading };
    this.height = heightOf(ground.place);
    const scale = ground.metresPerPixel / now.metresPerPixel;
    const { frustum } = this.scene.camera;
    if (frustum instanceof OrthographicFrustum) frustum.width = (frustum.width ?? 1) * scale;
    this.stand(moveCamera(this.pose, from, to, scale));
  }

  /** Puts the camera somewhere; that is no move of the globe's own. */
  stand(pose: CameraPose): void {
    const { camera } = this.scene;
    camera.cancelFlight();
    standCamera(camera, pose);
    this.know();
    this.scene.requestRender();
  }

  /** Whether the camera is another than the one known. */
  get hasMoved(): boolean {
    return this.#numbers().some((value, at) => {
      const off = Math.abs(value - this.#known[at]!);
      return off > ROUNDING * Math.max(1, Math.abs(value));
    });
  }

  /** Takes the camera as it is for known. */
  know(): void {
    this.#known = this.#numbers();
  }

  /** The outline of the ground in the picture: places of ECEF. */
  get footprint(): Vector[] {
    const { halves } = lensOf(this.scene);
    const terrain = this.#terrain;
    if (!terrain) return footprintOf(this.pose, halves, this.#height);
    return footprintOf(this.pose, halves, 0, (ray) => this.#pickTerrain(ray));
  }

  /**
   * The place of the point that the globe shows nearest to a place of its picture, as it is recorded: ECEF.
   * @param at CSS pixels from the upper left
   * @throws SourceError, DecodeError where the record cannot be read again; the signal's reason when aborted
   */
  async pick(at: ScreenPlace, signal: AbortSignal): Promise<Vector | undefined> {
    const hits = await Promise.all(this.layers.map((layer) => layer.pick(at, { signal })));
    const eye = this.scene.camera.positionWC;
    const away = (hit: (typeof hits)[number]) =>
      hit ? Cartesian3.distance(eye, hit.position) : Number.POSITIVE_INFINITY;
    const nearest = hits.sort((a, b) => away(a) - away(b))[0];
    return nearest && vectorOf(nearest.position);
  }

  /** The place that the globe shows at a place of its picture: of a point, else of the ground. @throws as {@link pick} */
  async placeAt(at: ScreenPlace, signal: AbortSignal): Promise<Vector | undefined> {
    const point = await this.pick(at, signal);
    if (point) return point;
    const found = this.scene.camera.getPickRay(new Cartesian2(at.x, at.y));
    const ray = found && { origin: vectorOf(found.origin), direction: vectorOf(found.direction) };
    return ray && ((this.#terrain && this.#pickTerrain(ray)) ?? meetSurface(ray, this.#height));
  }

  /** Where a place of ECEF is in the picture; undefined where it is behind the camera. */
  pixelOf(place: Vector): ScreenPlace | undefined {
    return this.scene.cartesianToCanvasCoordinates(new Cartesian3(...place));
  }

  /** Flies to where the camera looks at a place in the way in which it looks now. @param seconds 0: at once */
  flyTo(place: Vector, seconds: number): void {
    const { view } = this;
    const from = { place: view.place, heading: view.heading };
    const pose = moveCamera(this.pose, from, { place, heading: view.heading }, 1);
    const [destination, direction, up] = [pose.position, pose.direction, pose.up].map(
      ([x, y, z]) => new Cartesian3(x, y, z),
    );
    this.#height = heightOf(place);
    this.scene.camera.flyTo({ destination, orientation: { direction, up }, duration: seconds });
    this.scene.requestRender();
  }

  /** Layers of points that are shown. */
  get layers(): PointCloudLayer[] {
    return layersIn(this.scene.primitives);
  }

  dispose(): void {
    for (const unwatch of this.#unwatch) unwatch();
  }

  /** The globe where it has terrain: elsewhere it is the ellipsoid, better than its triangles are. */
  get #terrain() {
    const { globe } = this.scene;
    return globe?.show && !(globe.terrainProvider instanceof EllipsoidTerrainProvider) ? globe : undefined;
  }

  /** @param pose a camera whose direction is that of the ray */
  #lookedAt(pose: CameraPose): Vector {
    const { position: origin, direction } = pose;
    const onTerrain = this.#terrain && this.#pickTerrain({ origin, direction });
    if (onTerrain) this.#height = geodeticOf(onTerrain)[2];
    return onTerrain ?? placeLookedAt(pose, this.#height);
  }

  #pickTerrain({ origin, direction }: Ray): Vector | undefined {
    const { ray, place } = scratch;
    Cartesian3.fromElements(...origin, ray.origin);
    Cartesian3.fromElements(...direction, ray.direction);
    const found = this.scene.globe.pick(ray, this.scene, place);
    return found && vectorOf(found);
  }

  /** All of the camera that says what it looks at. */
  #numbers(): number[] {
    const { positionWC: p, directionWC: d, upWC: u, frustum } = this.scene.camera;
    const { fovy = 0, width = 0 } = frustum as { fovy?: number; width?: number };
    return [p.x, p.y, p.z, d.x, d.y, d.z, u.x, u.y, u.z, fovy, width];
  }
}

function distance(a: Vector, b: Vector): number {
  return Math.hypot(...difference(a, b));
}

import { difference, dot, type Vector } from "@groma/georef";
import { Cartesian3, EllipsoidTerrainProvider, Ray, type Scene } from "cesium";
import {
  alongRay,
  heightOf,
  meetSurface,
  placeInPicture,
  rayThrough,
  type ScreenPlace,
} from "../camera/index.js";
import { lensOf, poseOf, vectorOf } from "../cesium/scene-camera.js";
import type { NavigatedLayer } from "./options.js";

/** Milliseconds for which a drag waits for the point under it before it takes the ground; drawn by a processor, it takes a while. */
const PATIENCE = 2000;
/** CSS pixels around the pointer in which a point counts. */
const WINDOW = 15;
/** Ground that lies this many times as far as what was moved about last is not meant: the view passes over it. */
const FAR = 20;

/** Finds what a place of the picture shows, to be moved about: a point, else the ground, else what is as far as the last. */
export class Anchors {
  readonly #scene: Scene;
  readonly #layers: () => readonly NavigatedLayer[];
  #last: Vector | undefined;

  constructor(scene: Scene, layers: () => readonly NavigatedLayer[]) {
    this.#scene = scene;
    this.#layers = layers;
  }

  /** From now on a place, ECEF, is what was found last. */
  found(place: Vector): void {
    this.#last = place;
  }

  /** Metres from the camera to what was found last; where that is out of sight, to the nearest layer, or to the ground. */
  get reach(): number {
    const pose = poseOf(this.#scene.camera);
    const { position } = pose;
    const lens = lensOf(this.#scene);
    const seen = this.#last && placeInPicture(pose, lens, this.#last);
    if (this.#last && seen && seen.x >= 0 && seen.y >= 0 && seen.x <= lens.width && seen.y <= lens.height) {
      return Math.hypot(...difference(this.#last, position));
    }
    const eye = this.#scene.camera.positionWC;
    const away = this.#layers().map(({ boundingSphere: { center } }) => Cartesian3.distance(eye, center));
    return Math.max(
      1,
      Math.min(...away, away.length > 0 ? Number.POSITIVE_INFINITY : Math.abs(heightOf(position))),
    );
  }

  /**
   * What the picture shows at a place: where the ray through it is as deep as the point drawn nearest to it, so that nothing
   * jumps to the pointer. Nothing hangs on how good it is but the speed: where the pick of a point fails or takes too long, it
   * is that of {@link guess}.
   */
  async find(at: ScreenPlace, signal: AbortSignal): Promise<Vector> {
    const guess = this.guess(at);
    const pose = poseOf(this.#scene.camera);
    const ray = rayThrough(pose, lensOf(this.#scene), at);
    const late = new Promise<undefined>((resolve) => setTimeout(resolve, PATIENCE));
    const found = await Promise.race([this.#pick(at, signal).catch(() => undefined), late]);
    const depth = found && dot(difference(found, ray.origin), pose.direction);
    const place = depth ? alongRay(ray, depth / dot(ray.direction, pose.direction)) : guess;
    if (!signal.aborted) this.#last = place;
    return place;
  }

  /** What is there without the points: the terrain, the ellipsoid at the height of the last place, or its distance. */
  guess(at: ScreenPlace): Vector {
    const { camera, globe } = this.#scene;
    const ray = rayThrough(poseOf(camera), lensOf(this.#scene), at);
    const { reach } = this;
    const terrain =
      globe?.show && !(globe.terrainProvider instanceof EllipsoidTerrainProvider) ? globe : undefined;
    const met = terrain?.pick(
      new Ray(new Cartesian3(...ray.origin), new Cartesian3(...ray.direction)),
      this.#scene,
    );
    const ground = met ? vectorOf(met) : meetSurface(ray, this.#height());
    if (ground && Math.hypot(...difference(ground, ray.origin)) < FAR * reach) return ground;
    return alongRay(ray, reach);
  }

  /** Height above WGS 84 at which the ground is taken to be, metres. */
  #height(): number {
    if (this.#last) return heightOf(this.#last);
    const [layer] = this.#layers();
    return layer ? heightOf(vectorOf(layer.boundingSphere.center)) : 0;
  }

  async #pick(at: ScreenPlace, signal: AbortSignal): Promise<Vector | undefined> {
    const picks = this.#layers().map((layer) => layer.pickPosition(at, { window: WINDOW, signal }));
    const places = (await Promise.all(picks)).filter((place) => place !== undefined);
    const eye = this.#scene.camera.positionWC;
    places.sort((a, b) => Cartesian3.distanceSquared(eye, a) - Cartesian3.distanceSquared(eye, b));
    return places[0] && vectorOf(places[0]);
  }
}

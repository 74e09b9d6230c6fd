import { difference, type Vector } from "@groma/georef";
import { OrthographicFrustum, type Scene } from "cesium";
import type { CameraPose, Lens } from "../camera/index.js";
import { lensOf, poseOf, standCamera } from "../cesium/scene-camera.js";
import { ALL_PITCHES, FARTHEST, keepClear, type PitchLimits, zoomAbout } from "./motions/index.js";
import type { NavigatedLayer, NavigationSettings } from "./options.js";

/** Metres from a place at most, whatever Cesium's limit is. */
const GREATEST_DISTANCE = 1e8;
/** For a camera that stays above what it orbits. */
const FROM_ABOVE: PitchLimits = { least: -Math.PI / 2, greatest: 0 };

/** Moves the camera of a scene within the limits that hold there. */
export class Mover {
  readonly #scene: Scene;
  readonly #settings: Readonly<NavigationSettings>;
  readonly #layers: () => readonly NavigatedLayer[];

  /** @param settings as they are at the moment */
  constructor(scene: Scene, settings: Readonly<NavigationSettings>, layers: () => readonly NavigatedLayer[]) {
    this.#scene = scene;
    this.#settings = settings;
    this.#layers = layers;
  }

  get pose(): CameraPose {
    return poseOf(this.#scene.camera);
  }

  get lens(): Lens {
    return lensOf(this.#scene);
  }

  /** How far the camera may be tilted about a place; about its own, it may look anywhere. */
  pitches(place: Vector, { position }: CameraPose): PitchLimits {
    return this.#settings.lookUnder || place === position ? ALL_PITCHES : FROM_ABOVE;
  }

  /** Cesium's limits of the distance hold; without perspective the picture grows by it. */
  zoom(pose: CameraPose, place: Vector, scale: number): CameraPose {
    if (scale === 1) return pose;
    const { camera, screenSpaceCameraController: limits } = this.#scene;
    const away = Math.hypot(...difference(pose.position, place));
    const least = Math.min(1, limits.minimumZoomDistance / away);
    const greatest = Math.max(1, Math.min(limits.maximumZoomDistance, GREATEST_DISTANCE) / away);
    const allowed = Math.min(greatest, Math.max(least, scale));
    const { frustum } = camera;
    if (frustum instanceof OrthographicFrustum) frustum.width = (frustum.width ?? 1) * allowed;
    return zoomAbout(pose, place, allowed);
  }

  /** Puts the camera there, or beside the points that are in its way. */
  show(before: CameraPose, pose: CameraPose): void {
    if (pose === before || !pose.position.every(Number.isFinite)) return;
    const clearance = this.#settings.collision;
    const [from, to] = [before.position, pose.position];
    const position = clearance > 0 ? this.#clear(from, to, clearance) : to;
    standCamera(this.#scene.camera, { ...pose, position });
  }

  #clear(from: Vector, to: Vector, clearance: number): Vector {
    // Pushed aside, it leaves its line by no more than its length.
    const length = Math.min(Math.hypot(...difference(to, from)), FARTHEST * clearance);
    const reach = clearance + 2 * length;
    const points = this.#layers().flatMap((layer) => layer.drawnNear(from, reach));
    return points.length === 0 ? to : keepClear(from, to, clearance, points);
  }
}

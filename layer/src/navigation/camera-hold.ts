import { Matrix4, type Scene, SceneMode } from "cesium";

/** What of Cesium's own navigation moves the camera. */
const MOVES = ["enableRotate", "enableTranslate", "enableZoom", "enableTilt", "enableLook"] as const;

/**
 * Takes the camera from Cesium's own navigation and gives it back: only in 3D, and only where the camera is bound to nothing
 * that moves. `enableInputs` is left alone: it says that a flight or a tool has the camera for the moment.
 */
export class CameraHold {
  readonly #scene: Scene;
  #before: { readonly moves: readonly boolean[]; readonly collision: boolean } | undefined;

  constructor(scene: Scene) {
    this.#scene = scene;
  }

  get held(): boolean {
    return this.#before !== undefined;
  }

  /** @param wanted whether the camera is wanted @param lookUnder whether it may go below the ground */
  update(wanted: boolean, lookUnder: boolean): void {
    const { mode, camera, screenSpaceCameraController: own } = this.#scene;
    const free = mode === SceneMode.SCENE3D && Matrix4.equals(camera.transform, Matrix4.IDENTITY);
    if (!wanted || !free) {
      this.release();
      return;
    }
    this.#before ??= { moves: MOVES.map((name) => own[name]), collision: own.enableCollisionDetection };
    for (const name of MOVES) own[name] = false;
    own.enableCollisionDetection = this.#before.collision && !lookUnder;
  }

  /** Whether the camera may be moved now: a flight ends for it, while a tool that has it keeps it. */
  take(): boolean {
    const { camera, screenSpaceCameraController: own } = this.#scene;
    if (!this.held) return false;
    if (!own.enableInputs) camera.cancelFlight();
    return own.enableInputs;
  }

  /** Gives the camera back. */
  release(): void {
    if (!this.#before) return;
    const { screenSpaceCameraController: own } = this.#scene;
    for (const [at, name] of MOVES.entries()) own[name] = this.#before.moves[at];
    own.enableCollisionDetection = this.#before.collision;
    this.#before = undefined;
  }
}

import { type Event, SceneMode } from "cesium";
import type { StreamProgress } from "../cloud/index.js";
import type { FrameReport } from "../drawing/frame.js";
import { FrameFailures } from "../drawing/frame-failures.js";
import { callListener } from "../errors/index.js";
import type { SharedBudget } from "../octree/index.js";
import type { FrameState } from "./engine/cesium-private.js";

/** The events of a layer that tell of its frames. */
export interface EventSource {
  readonly cloud: { readonly name: string };
  readonly error: Event<(error: Error) => void>;
  readonly loadProgress: Event<(progress: StreamProgress) => void>;
  readonly allNodesLoaded: Event<() => void>;
}

/** Tells of frames, each time after the frame, where a listener may change the scene, and asks for further ones. */
export class FrameEvents {
  readonly #layer: EventSource;
  readonly #failures = new FrameFailures();
  #scene: FrameState["camera"]["_scene"] | undefined;
  #warned = false;
  /** Stops listening to the budget. */
  #unwatch: () => void = () => undefined;

  constructor(layer: EventSource) {
    this.#layer = layer;
  }

  /** Has the scene draw a frame whenever another view has changed the parts of a budget, in place of the one before. */
  watch(budget: SharedBudget | undefined): void {
    this.#unwatch();
    this.#unwatch = budget?.onChange(() => this.redraw()) ?? (() => undefined);
  }

  /** Has the scene that showed the layer last draw a frame. */
  redraw(): void {
    this.#scene?.requestRender();
  }

  /** Warns once where a scene has views that points are not drawn in. */
  shownIn(mode: SceneMode): void {
    const flat = mode === SceneMode.SCENE2D || mode === SceneMode.COLUMBUS_VIEW;
    if (!flat || this.#warned) return;
    this.#warned = true;
    const { name } = this.#layer.cloud;
    console.warn(`${name}: point clouds are drawn in 3D only, not in 2D and Columbus view`);
  }

  /** Raises what failed, unless it is known; undefined: nothing did. */
  failed(thrown: unknown, { afterRender }: FrameState): void {
    const { cloud, error: event } = this.#layer;
    const error = this.#failures.note(thrown, cloud.name);
    if (!error) return;
    afterRender.push(() => {
      raise(event, error);
      return false;
    });
  }

  /** Raises what a frame that was drawn came to, and asks for a further one where that would show more. */
  drawn({ progress, changed, finished, done }: FrameReport, { afterRender, camera }: FrameState): void {
    this.#scene = camera._scene;
    if (done) this.#failures.clear();
    const { loadProgress, allNodesLoaded } = this.#layer;
    afterRender.push(() => {
      if (changed) raise(loadProgress, progress);
      if (finished) raise(allNodesLoaded);
      return !done;
    });
  }
}

/** Raises an event within Cesium's render loop, which an error of a listener must not end. */
function raise<Arguments extends unknown[]>(
  event: Event<(...values: Arguments) => void>,
  ...values: Arguments
): void {
  callListener(() => event.raiseEvent(...values));
}

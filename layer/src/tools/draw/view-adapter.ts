import type { Vertex } from "../measure/index.js";

/** A place of a view, CSS pixels from its upper left. */
export interface ScreenPoint {
  readonly x: number;
  readonly y: number;
}

/** Class that the element of a view bears while a figure is drawn there: clicks are the figure's. */
export const DRAWING_CLASS = "groma-drawing";

/** What drawing needs of a view; one is made for each library of views. */
export interface ViewAdapter {
  /** The element that the view is drawn in: pointer and keys are heard there, figures are laid over it. */
  readonly element: HTMLElement;
  /**
   * The record that the view shows nearest to a place, as a vertex.
   * @param reach pixels around the place in which a point counts
   * @returns undefined where there is none
   */
  pick(at: ScreenPoint, reach: number, signal: AbortSignal): Promise<Vertex | undefined>;
  /**
   * Where the view shows a vertex; undefined where it does not.
   * @param near which of several places, on a map that shows the earth more than once: the one nearest to this, else to
   *   the middle of the view
   */
  project(vertex: Vertex, near?: ScreenPoint): ScreenPoint | undefined;
  /** What readers know the view by, where a tool draws on several: the group of its figures is named after it. */
  readonly name?: string;
  /** Calls back after each frame in which figures may have moved. @returns what ends that */
  onFrame(listener: () => void): () => void;
  /** Has the view drawn again, where it draws on demand only. */
  redraw(): void;
  /** Told when a figure is begun and when it ends: clicks are the figure's meanwhile, so two of them should not zoom. */
  drawing?(active: boolean): void;
  /** The view's own buttons and panels that lie over it: labels stand beside them. */
  covering?(): readonly Element[];
}

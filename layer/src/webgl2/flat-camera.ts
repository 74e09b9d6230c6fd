/** A camera without perspective: over a map, or before a section. */
export interface FlatCamera {
  /** Pixels of the canvas. */
  readonly width: number;
  readonly height: number;
  /** Pixels per CSS pixel. */
  readonly pixelRatio: number;
  /** Metres by which the copies of the points that show are moved: the worlds of a map. */
  readonly worlds: readonly number[];
  /** Eye → clip, column-major. */
  readonly projection: readonly number[];
  /**
   * Node frame → eye, column-major: differences are formed in float64.
   * @param origin of the node frame, metres
   * @param world one of {@link worlds}
   */
  modelView(origin: ArrayLike<number>, world: number): number[];
}

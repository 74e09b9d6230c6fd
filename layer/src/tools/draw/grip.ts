import type { Vertex } from "../measure/index.js";

/** A vertex of a figure, or the middle of the edge behind it. */
export interface Grip {
  readonly id: string;
  readonly vertex: number;
  readonly between: boolean;
}

/** A vertex on its way. */
export interface Drag {
  readonly grip: Grip;
  /** Where it would be put; undefined where there is no point. */
  vertex: Vertex | undefined;
}

/** Vertices with the one that is on its way. */
export function dragged(placed: readonly Vertex[], { grip, vertex }: Drag): readonly Vertex[] {
  if (!vertex) return placed;
  return grip.between ? placed.toSpliced(grip.vertex + 1, 0, vertex) : placed.with(grip.vertex, vertex);
}

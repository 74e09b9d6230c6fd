import type { Column, NodeVertices } from "../workers/index.js";

/** Points as a view draws them: those of a node that is placed, or those of a section. */
export interface DrawnVertices
  extends Pick<
    NodeVertices,
    "positions" | "count" | "order" | "frame" | "box" | "bound" | "step" | "toCube" | "onGlobe"
  > {
  readonly columns: {
    /** An attribute by name; always the same object until the points look different. */
    get(name: string): Column | undefined;
  };
}

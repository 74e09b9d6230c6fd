import type { DrawnNode } from "../drawing/drawn-node.js";
import type { DrawnVertices } from "../drawing/drawn-vertices.js";
import type { UploadedNode } from "../drawing/node-uploads.js";
import { PagedNode } from "../drawing/paged-node.js";
import type { VertexPages } from "../drawing/vertex-pages.js";
import { columnMajor } from "../effects/index.js";
import type { GlTypes } from "./gl-objects.js";

/** What is drawn with. */
export interface GlView extends GlTypes {
  readonly node: NodeDrawable;
}

/** A node as a frame shows it. */
export type GlNode = DrawnNode<GlView>;

/** Places as they are: 3 rows of 4. */
const STAYS = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** A node on the GPU. */
export class NodeDrawable extends PagedNode<GlTypes> implements UploadedNode {
  /** Node frame → its frame on the globe, column-major. */
  readonly onGlobe: readonly number[];

  constructor(pages: VertexPages<GlTypes>, vertices: DrawnVertices, slot: number) {
    super(pages, vertices, slot);
    this.onGlobe = columnMajor(vertices.onGlobe?.fromMap ?? STAYS);
  }

  /** From above, a height that all points are lifted by does not show; sections show heights as they are recorded. */
  lift(): void {}
}

import type { DrawnNode } from "../drawing/drawn-node.js";
import type { DrawnVertices } from "../drawing/drawn-vertices.js";
import type { Gpu } from "../drawing/gpu.js";
import { NodeBuffers } from "../drawing/node-buffers.js";
import type { UploadedNode } from "../drawing/node-uploads.js";
import type { AttributeSet } from "../drawing/vertex-attributes.js";
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
export class NodeDrawable extends NodeBuffers<GlTypes> implements UploadedNode {
  /** Node frame → its frame on the globe, column-major. */
  readonly onGlobe: readonly number[];

  constructor(gpu: Gpu<GlTypes>, vertices: DrawnVertices) {
    super(gpu, vertices);
    this.onGlobe = columnMajor(vertices.onGlobe?.fromMap ?? STAYS);
  }

  /** From above, a height that all points are lifted by does not show; sections show heights as they are recorded. */
  lift(): void {}

  /** Has its points drawn next, by a program that reads these attributes. */
  bind(gl: WebGL2RenderingContext, reads: AttributeSet): void {
    const { array, constants } = this.array(reads);
    gl.bindVertexArray(array);
    for (const { location, value } of constants) {
      const [x = 0, y = 0, z = 0, w = 1] = value;
      gl.vertexAttrib4f(location, x, y, z, w);
    }
  }
}

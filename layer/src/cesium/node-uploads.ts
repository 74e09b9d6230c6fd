import type { OctreeNode } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import type { Context, ShaderProgram } from "./cesium-private.js";
import { createDrawable, type DrawShared, type NodeDrawable } from "./node-drawable.js";

/** How much of a frame may go into uploads; whichever comes first ends it, one node always goes through. */
export interface UploadBudget {
  /** Default: 4. */
  readonly milliseconds: number;
  /** Default: 4 MiB. */
  readonly bytes: number;
}

const DEFAULT_BUDGET: UploadBudget = { milliseconds: 4, bytes: 4 * 1024 * 1024 };

/** The nodes of a layer that are on the GPU. */
export class NodeUploads {
  readonly #drawables = new Map<OctreeNode, NodeDrawable>();
  #bytes = 0;
  #heightOffset = 0;

  /** GPU buffers that are alive. */
  get buffers(): number {
    return this.#drawables.size;
  }

  /** Bytes in them. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Metres above their places at which nodes are drawn. */
  get heightOffset(): number {
    return this.#heightOffset;
  }

  get(node: OctreeNode): NodeDrawable | undefined {
    return this.#drawables.get(node);
  }

  /**
   * Uploads what is ready and not on the GPU yet, in the order given, within the budget.
   * @returns nodes that are ready but have to wait for a later frame
   */
  upload(
    context: Context,
    nodes: Iterable<OctreeNode>,
    vertices: (node: OctreeNode) => NodeVertices | undefined,
    shared: DrawShared,
    budget: UploadBudget = DEFAULT_BUDGET,
  ): number {
    const end = performance.now() + budget.milliseconds;
    let left = budget.bytes;
    let waiting = 0;
    for (const node of nodes) {
      if (this.#drawables.has(node)) continue;
      const content = vertices(node);
      if (!content) continue;
      const first = left === budget.bytes;
      if (!first && (performance.now() >= end || content.vertices.byteLength > left)) {
        waiting++;
        continue;
      }
      const drawable = createDrawable(context, content, shared, this.#heightOffset);
      this.#drawables.set(node, drawable);
      this.#bytes += drawable.bytes;
      left -= drawable.bytes;
    }
    return waiting;
  }

  /** Gives all commands another program. */
  setProgram(program: ShaderProgram): void {
    for (const { command } of this.#drawables.values()) command.shaderProgram = program;
  }

  /** Draws all nodes so many metres above their places, those to come as well. */
  lift(heightOffset: number): void {
    if (heightOffset === this.#heightOffset) return;
    this.#heightOffset = heightOffset;
    for (const drawable of this.#drawables.values()) drawable.lift(heightOffset);
  }

  /** Frees a node's buffer, if it has one. */
  free(node: OctreeNode): void {
    const drawable = this.#drawables.get(node);
    if (!drawable) return;
    this.#drawables.delete(node);
    this.#bytes -= drawable.bytes;
    drawable.destroy();
  }

  /** Frees all. */
  destroy(): void {
    for (const node of [...this.#drawables.keys()]) this.free(node);
  }
}

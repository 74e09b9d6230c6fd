import type { AttributeDeclaration } from "../effects/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import type { GpuObjects } from "./gpu-objects.js";
import { NodeDrawable } from "./node-drawable.js";

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
  #heightOffset = 0;

  /** Metres above their places at which nodes are drawn. */
  get heightOffset(): number {
    return this.#heightOffset;
  }

  /** The node, where all that these attributes read is on the GPU. */
  ready(node: OctreeNode, attributes: readonly AttributeDeclaration[]): NodeDrawable | undefined {
    const drawable = this.#drawables.get(node);
    return drawable && drawable.missingBytes(attributes) === 0 ? drawable : undefined;
  }

  /**
   * Uploads what is here and not on the GPU yet, in the order given, within the budget.
   * @returns nodes that are here but have to wait for a later frame
   */
  upload(
    objects: GpuObjects,
    nodes: Iterable<OctreeNode>,
    vertices: (node: OctreeNode) => NodeVertices | undefined,
    attributes: readonly AttributeDeclaration[],
    budget: UploadBudget = DEFAULT_BUDGET,
  ): number {
    const end = performance.now() + budget.milliseconds;
    let left = budget.bytes;
    let waiting = 0;
    for (const node of nodes) {
      let drawable = this.#drawables.get(node);
      if (drawable && drawable.missingBytes(attributes) === 0) continue;
      const content = drawable?.vertices ?? vertices(node);
      if (!content) continue;
      drawable ??= new NodeDrawable(objects, content, this.#heightOffset);
      const bytes = drawable.missingBytes(attributes);
      const first = left === budget.bytes;
      if (!first && (bytes > left || performance.now() >= end)) {
        waiting++;
        continue;
      }
      drawable.upload(attributes);
      this.#drawables.set(node, drawable);
      left -= bytes;
    }
    return waiting;
  }

  /** Frees of all nodes what none of these attributes reads. */
  keep(attributes: readonly AttributeDeclaration[]): void {
    for (const drawable of this.#drawables.values()) drawable.keep(attributes);
  }

  /** Draws all nodes so many metres above their places, those to come as well. */
  lift(heightOffset: number): void {
    if (heightOffset === this.#heightOffset) return;
    this.#heightOffset = heightOffset;
    for (const drawable of this.#drawables.values()) drawable.lift(heightOffset);
  }

  /** Nodes that are not among those shown, the one uploaded longest ago first. */
  idle(shown: ReadonlySet<OctreeNode>): OctreeNode[] {
    return [...this.#drawables.keys()].filter((node) => !shown.has(node));
  }

  /** Frees what a node has on the GPU. */
  free(node: OctreeNode): void {
    this.#drawables.get(node)?.destroy();
    this.#drawables.delete(node);
  }

  /** Frees all. */
  destroy(): void {
    for (const drawable of this.#drawables.values()) drawable.destroy();
    this.#drawables.clear();
  }
}

import type { FrameAllowance } from "../drawing/frame-allowance.js";
import type { OctreeNode } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { NodeDrawable } from "./node-drawable.js";
import type { AttributeSet } from "./vertex-attributes.js";

/** Bytes that a frame uploads at most, besides its allowance of time; one node always goes through. */
const BYTES = 4 * 1024 * 1024;

/** The nodes of a layer that are on the GPU. */
export class NodeUploads {
  readonly #drawables = new Map<OctreeNode, NodeDrawable>();
  #heightOffset = 0;

  /** Metres above their places at which nodes are drawn. */
  get heightOffset(): number {
    return this.#heightOffset;
  }

  /** The node, where all that programs with these attributes need is on the GPU. */
  ready(node: OctreeNode, sets: readonly AttributeSet[]): NodeDrawable | undefined {
    const drawable = this.#drawables.get(node);
    return drawable && sets.every((set) => drawable.has(set)) ? drawable : undefined;
  }

  /**
   * Uploads what is here and not on the GPU yet, in the order given, as far as the frame allows.
   * @returns nodes that are here but have to wait for a later frame
   */
  upload(
    objects: GpuObjects,
    nodes: Iterable<OctreeNode>,
    vertices: (node: OctreeNode) => NodeVertices | undefined,
    sets: readonly AttributeSet[],
    allowance: FrameAllowance,
  ): number {
    let left = BYTES;
    let waiting = 0;
    for (const node of nodes) {
      if (this.ready(node, sets)) continue;
      const there = this.#drawables.get(node);
      const content = there?.vertices ?? vertices(node);
      if (!content) continue;
      if (waiting > 0 || left <= 0 || !allowance.grants()) {
        waiting++;
        continue;
      }
      const drawable = there ?? new NodeDrawable(objects, content, this.#heightOffset);
      const before = drawable.bytes;
      for (const set of sets) drawable.upload(set);
      this.#drawables.set(node, drawable);
      left -= drawable.bytes - before;
    }
    return waiting;
  }

  /** Frees of all nodes what programs with these attributes do not read. */
  keep(sets: readonly AttributeSet[]): void {
    for (const drawable of this.#drawables.values()) drawable.keep(sets);
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

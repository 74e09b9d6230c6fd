import type { OctreeNode } from "../octree/index.js";
import type { DrawnVertices } from "./drawn-vertices.js";
import type { FrameAllowance } from "./frame-allowance.js";
import type { AttributeSet } from "./vertex-attributes.js";

/** Bytes that a frame uploads at most, besides its allowance of time; one node always goes through. */
const BYTES = 4 * 1024 * 1024;

/** A node on the GPU, as a view draws it. */
export interface UploadedNode {
  readonly vertices: DrawnVertices;
  /** How many points it has. */
  readonly count: number;
  /** Its number among all that is on the GPU: what is kept of each lies there in arrays. One that is freed leaves it to another. */
  readonly slot: number;
  /** Number of the page that it lies in: nodes of one page can be drawn by one call. */
  readonly page: number;
  /** Its first vertex there. */
  readonly first: number;
  /** Whether its points have changed since it was made, so that another one has to take its place. */
  readonly outdated: boolean;
  /** Bytes of its page that it fills. */
  readonly bytes: number;
  /** Whether programs that read these attributes can draw it. */
  has(set: AttributeSet): boolean;
  /** Puts on the GPU what programs with these attributes need. */
  upload(set: AttributeSet): void;
  /** Frees what programs with other attributes than these read. */
  keep(sets: readonly AttributeSet[]): void;
  /** Draws it so many metres above its place from now on. */
  lift(heightOffset: number): void;
  destroy(): void;
}

/** Nodes that a frame wants and, at the same indices, what there is of them. */
export interface WantedNodes<Node> {
  readonly nodes: readonly OctreeNode[];
  /** Their points, as far as they are here. */
  readonly vertices: readonly (DrawnVertices | undefined)[];
  /** What is on the GPU of them. */
  readonly uploaded: (Node | undefined)[];
}

/** Whether all that programs with these attributes need is on the GPU. */
export function isReady(uploaded: UploadedNode, sets: readonly AttributeSet[]): boolean {
  for (let index = 0; index < sets.length; index++) if (!uploaded.has(sets[index])) return false;
  return true;
}

/** The nodes of a layer that are on the GPU. */
export class NodeUploads<Node extends UploadedNode> {
  readonly #nodes = new Map<OctreeNode, Node>();
  readonly #make: (vertices: DrawnVertices, slot: number, heightOffset: number) => Node;
  /** Slots that were left, and the next one that nobody had. */
  readonly #left: number[] = [];
  #next = 0;
  #heightOffset = 0;
  /** The changes of points up to which nodes were looked through for outdated ones, and whether some were. */
  #looked: number | undefined;
  #outdated = false;

  /** @param make a node of which nothing is on the GPU yet, so many metres above its place */
  constructor(make: (vertices: DrawnVertices, slot: number, heightOffset: number) => Node) {
    this.#make = make;
  }

  /** Metres above their places at which nodes are drawn. */
  get heightOffset(): number {
    return this.#heightOffset;
  }

  /** All of them, in view or not. */
  get all(): Iterable<Node> {
    return this.#nodes.values();
  }

  /** What is on the GPU of nodes, at the same indices: looked up once in a frame. */
  of(nodes: readonly OctreeNode[]): (Node | undefined)[] {
    const uploaded: (Node | undefined)[] = [];
    for (let index = 0; index < nodes.length; index++) uploaded.push(this.#nodes.get(nodes[index]));
    return uploaded;
  }

  /**
   * Uploads what is here and not on the GPU yet, in the order given, as far as the frame allows.
   * @param changes a number that is another one whenever points that are here may look different
   * @returns nodes that are here but have to wait for a later frame
   */
  upload(
    wanted: WantedNodes<Node>,
    sets: readonly AttributeSet[],
    allowance: FrameAllowance,
    changes: number,
  ): number {
    const { nodes, vertices, uploaded: all } = wanted;
    let left = BYTES;
    let waiting = 0;
    const outdated = this.#someOutdated(changes);
    for (let index = 0; index < nodes.length; index++) {
      const there = all[index];
      if (there && !(outdated && there.outdated) && isReady(there, sets)) continue;
      const content = there?.vertices ?? vertices[index];
      if (!content) continue;
      const node = nodes[index];
      if (waiting > 0 || left <= 0 || !allowance.grants()) {
        waiting++;
        continue;
      }
      // An outdated one is drawn until another is whole.
      const kept = there?.outdated ? undefined : there;
      const uploaded = kept ?? this.#make(content, this.#left.pop() ?? this.#next++, this.#heightOffset);
      const before = uploaded.bytes;
      for (const set of sets) uploaded.upload(set);
      if (!kept && there) this.#destroy(there);
      this.#nodes.set(node, uploaded);
      all[index] = uploaded;
      left -= uploaded.bytes - before;
    }
    return waiting;
  }

  /** Frees of all nodes what programs with other attributes than these read. */
  keep(sets: readonly AttributeSet[]): void {
    for (const uploaded of this.#nodes.values()) uploaded.keep(sets);
  }

  /** Draws all nodes so many metres above their places, those to come as well. @returns whether they were not before */
  lift(heightOffset: number): boolean {
    if (heightOffset === this.#heightOffset) return false;
    this.#heightOffset = heightOffset;
    for (const uploaded of this.#nodes.values()) uploaded.lift(heightOffset);
    return true;
  }

  /** Nodes that are not among those shown, the one uploaded longest ago first. */
  idle(shown: ReadonlySet<OctreeNode>): OctreeNode[] {
    return [...this.#nodes.keys()].filter((node) => !shown.has(node));
  }

  /** Frees what a node has on the GPU. */
  free(node: OctreeNode): void {
    const uploaded = this.#nodes.get(node);
    if (uploaded) this.#destroy(uploaded);
    this.#nodes.delete(node);
  }

  /** Frees all. */
  destroy(): void {
    for (const uploaded of this.#nodes.values()) this.#destroy(uploaded);
    this.#nodes.clear();
  }

  #destroy(uploaded: Node): void {
    uploaded.destroy();
    this.#left.push(uploaded.slot);
  }

  /** Whether any node is outdated, in view or not: found out when points may have changed, and while some are. */
  #someOutdated(changes: number): boolean {
    if (changes === this.#looked && !this.#outdated) return false;
    this.#looked = changes;
    this.#outdated = false;
    for (const uploaded of this.#nodes.values()) this.#outdated ||= uploaded.outdated;
    return this.#outdated;
  }
}

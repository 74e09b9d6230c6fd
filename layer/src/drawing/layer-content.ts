import { type EffectPlan, widestPoint, withoutClips } from "../effects/index.js";
import type { ByteLedger, OctreeNode, Selection } from "../octree/index.js";
import type { ClipAnswers } from "./clip-answers.js";
import { DrawOrder } from "./draw-order.js";
import type { DrawnNode, GroupedNodes, ViewTypes } from "./drawn-node.js";
import type { DrawnVertices } from "./drawn-vertices.js";
import type { FrameAllowance } from "./frame-allowance.js";
import type { Gpu } from "./gpu.js";
import type { Material } from "./material.js";
import { Materials } from "./materials.js";
import type { NodeGroup } from "./node-group.js";
import { isReady, NodeUploads } from "./node-uploads.js";
import { type LogarithmicDepth, pointProgramsOf, programsOf } from "./program-needs.js";
import { Programs } from "./programs.js";
import type { AttributeSet } from "./vertex-attributes.js";
import { VertexPages } from "./vertex-pages.js";

/** What a frame is to show. */
export interface ContentRequest {
  readonly selection: Pick<Selection, "nodes" | "counts">;
  /** What is here of these nodes, at the same indices. */
  readonly vertices: readonly (DrawnVertices | undefined)[];
  /** How far away these nodes begin, above 0, metres; undefined where it does not matter which are drawn first. */
  readonly nearest?: ArrayLike<number> | undefined;
  /** Another number than before whenever points that are here may look different. */
  readonly changes: number;
  readonly plan: EffectPlan;
  readonly clips: Pick<ClipAnswers, "form" | "of" | "advance">;
  readonly depth: LogarithmicDepth;
  /** What of it may be prepared in this frame. */
  readonly allowance: FrameAllowance;
}

/** A node of a frame that is being put together. */
interface Drawing<V extends ViewTypes> extends DrawnNode<V> {
  row: number;
  octreeIndex: number;
  clipRecords: readonly [first: number, count: number];
}

/** Nodes that are drawn with the same effects. */
interface Members<V extends ViewTypes> {
  readonly group: NodeGroup<V>;
  readonly plan: EffectPlan;
  readonly nodes: Drawing<V>[];
  /** How far away they begin, at the same indices; empty where that is not known. */
  readonly nearest: number[];
}

const NO_RECORDS = [0, 0] as const;

/** What a layer has on the GPU of one context, and what of it the last frame shows. */
export class LayerContent<V extends ViewTypes> {
  readonly programs: Programs<V>;
  readonly #gpu: Gpu<V>;
  readonly #materials: Materials<V>;
  readonly #pages: VertexPages<V>;
  readonly #uploads: NodeUploads<V["node"]>;
  readonly #order = new DrawOrder();
  #depth: LogarithmicDepth = { own: false, scene: false };
  #nodes: DrawnNode<V>[] = [];
  #groups: NodeGroup<V>[] = [];
  #undrawn = 0;
  #points = 0;

  /**
   * @param base uniforms that the view itself fills
   * @param makeNode a node of which nothing is in the pages yet, of a slot, so many metres above its place
   */
  constructor(
    gpu: Gpu<V>,
    base: V["uniforms"],
    makeNode: (
      pages: VertexPages<V>,
      vertices: DrawnVertices,
      slot: number,
      heightOffset: number,
    ) => V["node"],
  ) {
    this.#gpu = gpu;
    this.programs = new Programs(gpu);
    this.#materials = new Materials(gpu, base);
    this.#pages = new VertexPages(gpu);
    this.#uploads = new NodeUploads((vertices, slot, heightOffset) =>
      makeNode(this.#pages, vertices, slot, heightOffset),
    );
  }

  /** Nodes of the last frame, as they are drawn, by rising `firstId`. */
  get nodes(): readonly DrawnNode<V>[] {
    return this.#nodes;
  }

  /** Points of the last frame. */
  get points(): number {
    return this.#points;
  }

  /** Nodes on the GPU: those of the last frame, and those of the frames before that there was room for. */
  get uploaded(): Iterable<V["node"]> {
    return this.#uploads.all;
  }

  /** What they are drawn in, the rows of each of their tables as the frame began. */
  get groups(): readonly NodeGroup<V>[] {
    return this.#groups;
  }

  /** All nodes of the last frame by what they are drawn in. */
  get grouped(): GroupedNodes<V> {
    return this.#groups.map((group) => [group, group.nodes] as const);
  }

  /** Nodes that the last frame wanted and that were here, and that it did not draw yet. */
  get undrawn(): number {
    return this.#undrawn;
  }

  /** What the last frame's nodes are drawn with. */
  get material(): Material<V> | undefined {
    return this.#materials.shown;
  }

  /** Where depth was logarithmic in the last frame. */
  get depth(): LogarithmicDepth {
    return this.#depth;
  }

  /** Greatest width of a point, CSS pixels. */
  get widestPoint(): number {
    const style = this.material?.style;
    return style ? widestPoint(style) : 0;
  }

  /** Metres above their places at which nodes are drawn. */
  get heightOffset(): number {
    return this.#uploads.heightOffset;
  }

  lift(heightOffset: number): void {
    if (!this.#uploads.lift(heightOffset)) return;
    for (const group of this.#groups) group.replace();
  }

  /**
   * Prepares what a frame shows, as far as it may. A new material and new volumes show once all that they need is there;
   * until then the former ones are drawn.
   * @returns steps that wait for a later frame: nodes to be uploaded or held against volumes, and a new material
   */
  prepare(request: ContentRequest): number {
    const { selection, vertices, changes, plan, clips, depth, allowance } = request;
    const { nodes } = selection;
    this.#depth = depth;
    this.#pages.tidy();
    this.programs.nextFrame();
    const materials = this.#materials;
    const material = materials.want(plan);
    const linked = this.programs.prepare(programsOf(material.plan, depth), allowance);
    const unformed = clips.form(vertices, allowance);
    const drawn = linked ? material : materials.shown;
    const wanted = { nodes, vertices, uploaded: this.#uploads.of(nodes) };
    const waiting = drawn ? this.#uploads.upload(wanted, this.#reads(drawn), allowance.last(), changes) : 0;
    const ready = materials.next && linked && unformed === 0 && (waiting === 0 || !materials.shown);
    // The first frame of a material makes what it draws into; where nothing is drawn yet, nothing else is worth to be waited for.
    if (ready && (!materials.shown || allowance.grants())) this.#change();
    if (unformed === 0 && materials.shown?.plan.key === plan.key) clips.advance();
    const { shown } = materials;
    if (shown === material) shown.update(plan);
    this.#nodes = shown ? this.#collect(shown, request, wanted.uploaded) : [];
    this.#points = pointsOf(this.#nodes);
    this.#undrawn = shown ? Math.max(waiting, unformed) : vertices.filter(Boolean).length;
    return waiting + unformed + (materials.next ? 1 : 0);
  }

  /** Nothing of the layer is in the next frame. */
  rest(): void {
    this.#nodes = [];
    this.#points = 0;
    this.#groups = [];
  }

  /** Frees what a node has on the GPU. */
  free(node: OctreeNode): void {
    this.#uploads.free(node);
    this.#nodes = this.#nodes.filter((drawn) => drawn.node !== node);
    for (const group of this.#groups) group.forget(node);
  }

  /** Frees what the last frame did not show until the layers that share a budget keep it. */
  keepWithin(budget: ByteLedger, owner: object): void {
    budget.report(owner, this.#gpu.bytes);
    if (budget.excess === 0) return;
    const shown = new Set(this.#nodes.map(({ node }) => node));
    for (const node of this.#uploads.idle(shown)) {
      this.#uploads.free(node);
      budget.report(owner, this.#gpu.bytes);
      if (budget.excess === 0) return;
    }
  }

  /** Frees all. */
  destroy(): void {
    this.rest();
    this.#uploads.destroy();
    this.#materials.destroy();
    this.programs.destroy();
  }

  /** Draws the material that was prepared from now on, and frees what only the former one read. */
  #change(): void {
    this.#materials.change();
    const { shown } = this.#materials;
    if (shown) this.#uploads.keep(this.#reads(shown));
  }

  /** What the programs of a material read of a node. */
  #reads({ plan }: Material<V>): AttributeSet[] {
    return this.programs.reads(pointProgramsOf(plan, this.#depth));
  }

  /** @param uploaded what is on the GPU of the selection's nodes, at the same indices */
  #collect(
    material: Material<V>,
    { selection, clips: answers, nearest }: ContentRequest,
    uploaded: readonly (V["node"] | undefined)[],
  ): DrawnNode<V>[] {
    const reads = this.#reads(material);
    const { plan } = material;
    const plain = withoutClips(plan);
    const membersOf = (plan: EffectPlan): Members<V> => ({
      ...{ group: material.groupOf(plan), plan },
      ...{ nodes: [], nearest: [] },
    });
    const cut = membersOf(plan);
    const whole = plain === plan ? cut : membersOf(plain);
    const drawn: Drawing<V>[] = [];
    const { nodes, counts } = selection;
    let firstId = 0;
    for (let index = 0; index < nodes.length; index++) {
      const there = uploaded[index];
      if (!there || !isReady(there, reads)) continue;
      const clips = answers.of(there.vertices);
      if (!clips || clips.state === "out") continue;
      const count = Math.min(counts[index], there.count);
      const members = clips.state === "in" ? whole : cut;
      const { group } = members;
      // Spread into one another, objects would take longer than all else that is done for a node.
      const one: Drawing<V> = {
        node: nodes[index],
        uploaded: there,
        count,
        firstId,
        clips,
        group,
        row: 0,
        octreeIndex: 0,
        clipRecords: NO_RECORDS,
      };
      members.nodes.push(one);
      if (nearest) members.nearest.push(nearest[index]);
      drawn.push(one);
      firstId += count;
    }
    const octreeIndices = material.showOctree(drawn);
    const clipRecords = material.showClips(drawn);
    for (let index = 0; octreeIndices && index < drawn.length; index++) {
      drawn[index].octreeIndex = octreeIndices[index];
    }
    for (let index = 0; index < clipRecords.length; index++) drawn[index].clipRecords = clipRecords[index];
    this.#groups = [];
    for (const { group, plan, nodes: members, nearest: distances } of whole === cut ? [cut] : [cut, whole]) {
      const ordered = this.#order.of(members, nearest && distances);
      for (let row = 0; row < ordered.length; row++) ordered[row].row = row;
      group.take(plan, ordered);
      if (ordered.length > 0) this.#groups.push(group);
    }
    return drawn;
  }
}

function pointsOf(nodes: readonly Pick<DrawnNode, "count">[]): number {
  let points = 0;
  for (let index = 0; index < nodes.length; index++) points += nodes[index].count;
  return points;
}

import { clipTexture, type NodeClips } from "../clips/index.js";
import {
  type EffectPlan,
  encodeVisibleOctree,
  layerUniforms,
  type PointCloudStyle,
  type PointFilter,
  readsNodeTexture,
  styleTextures,
} from "../effects/index.js";
import type { DrawnNode, ViewTypes } from "./drawn-node.js";
import type { Gpu, Texels } from "./gpu.js";
import { NodeGroup } from "./node-group.js";

/** First texel and number of records of a node in the texture of clips. */
type ClipRecords = readonly (readonly [first: number, count: number])[];

/** A style as it is drawn: its set of effects, the values of their uniforms and the textures that they read. */
export class Material<V extends ViewTypes> {
  readonly #gpu: Gpu<V>;
  readonly #uniforms: V["uniforms"];
  readonly #textures = new Map<string, V["texture"]>();
  /** By the keys of the effects that they are drawn with. */
  readonly #groups = new Map<string, NodeGroup<V>>();
  #plan: EffectPlan;
  #style: PointCloudStyle | undefined;
  #filter: PointFilter | undefined;
  /** Nodes and counts that the octree's texture shows. */
  #octree:
    | { readonly drawn: readonly Pick<DrawnNode, "node" | "count">[]; readonly indices: Uint32Array }
    | undefined;
  /** What the texture of clips holds, and where. */
  #clips: { readonly drawn: readonly NodeClips[]; readonly records: ClipRecords } | undefined;

  /** @param base uniforms that the view itself fills */
  constructor(gpu: Gpu<V>, plan: EffectPlan, base: V["uniforms"]) {
    this.#gpu = gpu;
    this.#plan = plan;
    this.#uniforms = gpu.uniforms(base);
  }

  /** The set of effects; its key stays the same. */
  get plan(): EffectPlan {
    return this.#plan;
  }

  /** The style that is shown; undefined before the first {@link update}. */
  get style(): PointCloudStyle | undefined {
    return this.#style;
  }

  /** Uniforms of all nodes. */
  get uniforms(): V["uniforms"] {
    return this.#uniforms;
  }

  /** The nodes that are drawn with a set of effects: that of the layer, or the same without volumes. */
  groupOf(plan: EffectPlan): NodeGroup<V> {
    let group = this.#groups.get(plan.key);
    if (!group) {
      group = new NodeGroup(this.#gpu, plan, this.#uniforms);
      this.#groups.set(plan.key, group);
    }
    return group;
  }

  /**
   * Takes the values of a frame.
   * @param plan one with the same key
   */
  update(plan: EffectPlan): void {
    this.#plan = plan;
    this.#uniforms.set(layerUniforms(plan));
    const {
      style,
      facts: { filter },
    } = plan.scene;
    if (style === this.#style && filter === this.#filter) return;
    this.#style = style;
    this.#filter = filter;
    for (const { name, ...texels } of styleTextures(plan)) this.#setTexture(name, texels);
  }

  /**
   * Encodes the octree of the drawn nodes in a texture, where an effect reads it.
   * @returns the texel of each node; undefined where none does
   */
  showOctree(drawn: readonly Pick<DrawnNode<V>, "node" | "uploaded" | "count">[]): Uint32Array | undefined {
    if (!readsNodeTexture(this.#plan, "octree")) return undefined;
    if (this.#octree && sameNodes(this.#octree.drawn, drawn)) return this.#octree.indices;
    const { texture, width, height, indices } = encodeVisibleOctree(
      drawn.map(({ node, uploaded: { vertices }, count }) => ({
        key: node.key,
        points: vertices.count,
        count,
        leaf: !node.children?.some((child) => child !== undefined),
        spacing: node.bounds?.spacing ?? 0,
        box: vertices.box,
      })),
    );
    this.#setTexture("u_octree", { width, height, data: texture });
    this.#octree = { drawn, indices };
    return indices;
  }

  /**
   * Lays the records of the drawn nodes' volumes into a texture, where an effect reads it.
   * @returns those of each node; none where no effect does
   */
  showClips(drawn: readonly Pick<DrawnNode<V>, "clips">[]): ClipRecords {
    if (!readsNodeTexture(this.#plan, "clips")) return [];
    const there = this.#clips;
    const same =
      there?.drawn.length === drawn.length && drawn.every(({ clips }, at) => clips === there.drawn[at]);
    if (there && same) return there.records;
    const clips = drawn.map((node) => node.clips);
    const { records, ...texels } = clipTexture(clips);
    this.#setTexture("u_clips", texels);
    this.#clips = { drawn: clips, records };
    return records;
  }

  /** Frees the textures. */
  destroy(): void {
    for (const group of this.#groups.values()) group.destroy();
    this.#groups.clear();
    for (const texture of this.#textures.values()) this.#gpu.free(texture);
    this.#textures.clear();
  }

  /** Gives a texture by name other texels; it is made anew only where its size changes. */
  #setTexture(name: string, texels: Texels): void {
    const there = this.#textures.get(name);
    if (there && there.width === texels.width && there.height === texels.height) {
      this.#gpu.writeTexture(there, texels);
      return;
    }
    this.#gpu.free(there);
    const texture = this.#gpu.dataTexture(texels);
    this.#textures.set(name, texture);
    this.#uniforms.setTexture(name, texture);
  }
}

function sameNodes(
  a: readonly Pick<DrawnNode, "node" | "count">[],
  b: readonly Pick<DrawnNode, "node" | "count">[],
): boolean {
  return (
    a.length === b.length && a.every(({ node, count }, at) => node === b[at].node && count === b[at].count)
  );
}

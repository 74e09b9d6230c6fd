import {
  type EffectPlan,
  encodeVisibleOctree,
  layerUniforms,
  type PointCloudStyle,
  type PointFilter,
  type SceneFacts,
  styleTextures,
} from "../effects/index.js";
import type { OctreeNode } from "../octree/index.js";
import type { DrawnNode } from "./drawn-node.js";
import type { Texture, UniformMap } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { UniformValues } from "./uniform-values.js";

/** A style as it is drawn: its set of effects, the values of their uniforms and the textures that they read. */
export class Look {
  readonly #objects: GpuObjects;
  readonly #layer: UniformValues;
  readonly #textureMap: Record<string, () => unknown>;
  readonly #textures = new Map<string, Texture>();
  readonly #nodes = new WeakMap<OctreeNode, UniformValues>();
  #plan: EffectPlan;
  #style: PointCloudStyle | undefined;
  #filter: PointFilter | undefined;
  /** Nodes and counts that the octree's texture shows. */
  #octree: { readonly drawn: readonly DrawnNode[]; readonly indices: Uint32Array } | undefined;

  /** @param view uniforms that the drawing side itself fills */
  constructor(objects: GpuObjects, plan: EffectPlan, view: UniformMap) {
    this.#objects = objects;
    this.#plan = plan;
    this.#textureMap = Object.create(view);
    this.#layer = new UniformValues(this.#textureMap);
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
  get map(): UniformMap {
    return this.#layer.map;
  }

  /** Uniforms of one node, and of all. */
  node(node: OctreeNode): UniformValues {
    let values = this.#nodes.get(node);
    if (!values) {
      values = new UniformValues(this.#layer.map);
      this.#nodes.set(node, values);
    }
    return values;
  }

  /**
   * Takes the values of a frame.
   * @param plan one with the same key
   */
  update(plan: EffectPlan, style: PointCloudStyle, facts: SceneFacts): void {
    this.#plan = plan;
    this.#layer.set(layerUniforms(plan, style, facts));
    const { filter } = plan.filters;
    if (style === this.#style && filter === this.#filter) return;
    this.#style = style;
    this.#filter = filter;
    for (const { name, width, height, data } of styleTextures(plan, style)) {
      this.setTexture(name, width, height, data);
    }
  }

  /**
   * Encodes the octree of the drawn nodes in a texture, where an effect reads it.
   * @returns the texel of each node; undefined where none does
   */
  showOctree(drawn: readonly DrawnNode[]): Uint32Array | undefined {
    const { active } = this.#plan;
    if (!active.has("adaptiveSize") && !active.has("levelOfDetail")) return undefined;
    if (this.#octree && sameNodes(this.#octree.drawn, drawn)) return this.#octree.indices;
    const { texture, width, height, indices } = encodeVisibleOctree(
      drawn.map(({ node, drawable: { vertices }, count }) => ({
        key: node.key,
        points: vertices.count,
        count,
        leaf: !node.children?.some((child) => child !== undefined),
        spacing: node.bounds?.spacing ?? 0,
        box: vertices.box,
      })),
    );
    this.setTexture("u_octree", width, height, texture);
    this.#octree = { drawn, indices };
    return indices;
  }

  /** Gives a texture by name other texels; it is made anew only where its size changes. */
  setTexture(name: string, width: number, height: number, data: Uint8Array | Float32Array): void {
    const there = this.#textures.get(name);
    if (there && there.width === width && there.height === height) {
      there.copyFrom({ source: { width, height, arrayBufferView: data } });
      return;
    }
    this.#objects.free(there);
    this.#textures.set(name, this.#objects.dataTexture(width, height, data));
    this.#textureMap[name] = () => this.#textures.get(name);
  }

  /** Frees the textures. */
  destroy(): void {
    for (const texture of this.#textures.values()) this.#objects.free(texture);
    this.#textures.clear();
  }
}

function sameNodes(a: readonly DrawnNode[], b: readonly DrawnNode[]): boolean {
  return (
    a.length === b.length && a.every(({ node, count }, at) => node === b[at].node && count === b[at].count)
  );
}

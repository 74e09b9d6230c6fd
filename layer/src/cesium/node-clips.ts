import { type ClipSet, type ClipVolumes, clipTexture, type NodeClips } from "../clips/index.js";
import type { PointCloud } from "../cloud/index.js";
import type { NodeVertices } from "../workers/index.js";
import type { DrawnNode } from "./drawn-node.js";
import type { Look } from "./look.js";

const WHOLE: NodeClips = { state: "in", count: 0, texels: [] };

/** What a layer's volumes make of its nodes, formed once per node and change of the volumes. */
export class NodeClipCache {
  #volumes: ClipVolumes | undefined;
  #nodes = new WeakMap<NodeVertices, NodeClips>();
  /** What the texture holds, and where. */
  #shown: readonly NodeClips[] = [];
  #records: readonly (readonly [number, number])[] = [];
  #look: Look | undefined;

  /** Takes the volumes of a frame. @throws StyleError STYLE_CLIP; PlacementError */
  follow(clips: ClipSet | undefined, cloud: PointCloud): void {
    const volumes = clips && clips.size > 0 ? clips.over(cloud) : undefined;
    if (volumes === this.#volumes) return;
    this.#volumes = volumes;
    this.#nodes = new WeakMap();
  }

  of(node: NodeVertices): NodeClips {
    if (!this.#volumes) return WHOLE;
    let clips = this.#nodes.get(node);
    if (!clips) {
      clips = this.#volumes.forNode(node);
      this.#nodes.set(node, clips);
    }
    return clips;
  }

  /**
   * Lays the records of the drawn nodes into a look's texture, where an effect reads it.
   * @returns first texel and number of records of each node
   */
  show(look: Look, drawn: readonly DrawnNode[]): readonly (readonly [number, number])[] {
    const { active } = look.plan;
    if (!active.has("clip") && !active.has("highlight")) return [];
    const shown = drawn.map(({ clips }) => clips);
    const same = shown.length === this.#shown.length && shown.every((clips, at) => clips === this.#shown[at]);
    if (same && look === this.#look) return this.#records;
    const { data, width, height, records } = clipTexture(shown);
    look.setTexture("u_clips", width, height, data);
    this.#shown = shown;
    this.#records = records;
    this.#look = look;
    return records;
  }
}

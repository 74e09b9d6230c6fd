import type { NodeBounds } from "../octree/index.js";
import type { Clip } from "./clip.js";
import { CLIP_WIDTH, ROLES } from "./clip-roles.js";
import { compileClip } from "./compile-clip.js";
import type { ClipMode, ClipNode, Relation, SourceSpace, Volume, VolumeRecord } from "./volume.js";

/** What all volumes together make of a node. */
export interface NodeClips {
  /** `in`: drawn as without volumes; `out`: not drawn at all; `crossing`: by its records. */
  readonly state: Relation;
  /** Number of records. */
  readonly count: number;
  /** Their texels; see {@link CLIP_ROLES}. */
  readonly texels: readonly number[];
}

/** ECEF, metres. */
type Sphere = Pick<NodeBounds, "x" | "y" | "z" | "radius">;

const WHOLE: NodeClips = { state: "in", count: 0, texels: [] };
const NOTHING: NodeClips = { state: "out", count: 0, texels: [] };
/** A record of no planes: everything is inside. */
const EVERYWHERE: VolumeRecord = { kind: 0, count: 0, bits: 0, texels: [] };

/**
 * Volumes over one data set, in float64. A point stays where it is inside one of the volumes that keep (if there are any)
 * and in none that cuts.
 */
export class ClipVolumes {
  readonly #volumes: readonly { readonly mode: ClipMode; readonly volume: Volume }[];
  readonly #keeps: boolean;
  /** Answers by the spheres asked about: a traversal asks about the same ones in every frame. */
  readonly #rejected = new WeakMap<Sphere, boolean>();

  /** @throws StyleError STYLE_CLIP */
  constructor(clips: readonly Clip[], space: SourceSpace) {
    this.#volumes = clips.map((clip) => ({ mode: clip.mode, volume: compileClip(clip, space) }));
    this.#keeps = clips.some(({ mode }) => mode === "inside");
  }

  /** Whether a record stays, by its exact place: ECEF, metres, and source coordinates. For picks and exports. */
  keeps(ecef: ArrayLike<number>, source: ArrayLike<number>): boolean {
    let kept = !this.#keeps;
    for (const { mode, volume } of this.#volumes) {
      if (mode === "highlight" || (mode === "inside" && kept)) continue;
      if (!volume.contains(ecef, source)) continue;
      if (mode === "outside") return false;
      kept = true;
    }
    return kept;
  }

  /** Whether a node is cut wholly, by the sphere around it (which must not change): such nodes need not be loaded. */
  rejects(sphere: Sphere): boolean {
    let rejected = this.#rejected.get(sphere);
    if (rejected === undefined) {
      rejected = this.#leavesNothingOf(sphere);
      this.#rejected.set(sphere, rejected);
    }
    return rejected;
  }

  #leavesNothingOf({ x, y, z, radius }: Sphere): boolean {
    let apart = this.#keeps;
    for (const { mode, volume } of this.#volumes) {
      if (mode === "highlight" || (mode === "inside" && !apart)) continue;
      const relation = volume.toSphere(x, y, z, radius);
      if (mode === "outside" && relation === "in") return true;
      if (mode === "inside" && relation !== "out") apart = false;
    }
    return apart;
  }

  /**
   * What is left of a node, with its records in its own frame: differences are formed in float64, so that float32 holds
   * them to 2⁻²⁴ of the node's size anywhere on the globe.
   */
  forNode(node: ClipNode): NodeClips {
    const cutting: { readonly role: number; readonly record: VolumeRecord }[] = [];
    const keeping: VolumeRecord[] = [];
    let kept = !this.#keeps;
    let wholly = kept;
    for (const { mode, volume } of this.#volumes) {
      const relation = volume.toNode(node);
      if (relation === "out") continue;
      const whole = relation === "in";
      if (mode === "inside") {
        kept = true;
        wholly ||= whole;
        if (!whole) keeping.push(relation);
      } else if (mode === "outside" && whole) {
        return NOTHING;
      } else {
        cutting.push({ role: ROLES[mode], record: whole ? EVERYWHERE : relation });
      }
    }
    if (!kept) return NOTHING;
    const records = [
      ...(wholly ? [] : keeping.map((record) => ({ role: ROLES.inside, record }))),
      ...cutting,
    ];
    if (records.length === 0) return WHOLE;
    return {
      state: "crossing",
      count: records.length,
      texels: records.flatMap(({ role, record }) => [
        ...[record.kind, role, record.count, record.bits],
        ...record.texels,
      ]),
    };
  }
}

/** The records of several nodes in one texture. */
export interface ClipTexture {
  /** RGBA32F, row by row. */
  readonly data: Float32Array;
  readonly width: number;
  readonly height: number;
  /** First texel and number of records of each node given, in their order. */
  readonly records: readonly (readonly [first: number, count: number])[];
}

/** Lays the records of nodes into one texture. */
export function clipTexture(nodes: readonly NodeClips[]): ClipTexture {
  const texels = nodes.reduce((sum, node) => sum + node.texels.length / 4, 0);
  const height = Math.max(1, Math.ceil(texels / CLIP_WIDTH));
  const data = new Float32Array(4 * CLIP_WIDTH * height);
  let at = 0;
  const records = nodes.map((node) => {
    const first = at / 4;
    data.set(node.texels, at);
    at += node.texels.length;
    return [first, node.count] as const;
  });
  return { data, width: CLIP_WIDTH, height, records };
}

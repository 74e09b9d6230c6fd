import type { NodeBounds } from "../octree/index.js";
import { CLIP_WIDTH, ROLES } from "./clip-roles.js";
import { finish, type Steps } from "./steps.js";
import type { ClipMode, ClipNode, Relation, Volume, VolumeRecord } from "./volume.js";

/** What all volumes together make of a node. */
export interface NodeClips {
  /** `in`: drawn as without volumes; `out`: not drawn at all; `crossing`: by its records. */
  readonly state: Relation;
  /** Number of records. */
  readonly count: number;
  /** Their texels; see {@link CLIP_ROLES}. */
  readonly texels: ArrayLike<number>;
}

/** A volume that is compiled for a data set, and what it is for. */
export interface ClipVolume {
  readonly mode: ClipMode;
  readonly volume: Volume;
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
  /** Number of volumes that cut: that keep their inside, or leave it out. */
  readonly cutting: number;
  /** Number of volumes that highlight. */
  readonly highlighting: number;
  readonly #volumes: readonly ClipVolume[];
  readonly #keeps: boolean;

  constructor(volumes: readonly ClipVolume[]) {
    this.#volumes = volumes;
    this.#keeps = volumes.some(({ mode }) => mode === "inside");
    this.highlighting = volumes.filter(({ mode }) => mode === "highlight").length;
    this.cutting = volumes.length - this.highlighting;
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

  /** Whether a node is cut wholly, by the sphere around it: such nodes need not be loaded. */
  rejects({ x, y, z, radius }: Sphere): boolean {
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
    return finish(this.forNodeInSteps(node));
  }

  /** The same in steps. */
  *forNodeInSteps(node: ClipNode): Steps<NodeClips> {
    const cutting: RoleRecord[] = [];
    const keeping: VolumeRecord[] = [];
    let kept = !this.#keeps;
    let wholly = kept;
    for (const { mode, volume } of this.#volumes) {
      const relation = yield* volume.toNode(node);
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
    return { state: "crossing", count: records.length, texels: texelsOf(records) };
  }
}

/** A record with what its volume is for. */
interface RoleRecord {
  readonly role: number;
  readonly record: VolumeRecord;
}

function texelsOf(records: readonly RoleRecord[]): Float32Array {
  const texels = new Float32Array(records.reduce((sum, { record }) => sum + 4 + record.texels.length, 0));
  let at = 0;
  for (const { role, record } of records) {
    texels.set([record.kind, role, record.count, record.bits], at);
    texels.set(record.texels, at + 4);
    at += 4 + record.texels.length;
  }
  return texels;
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

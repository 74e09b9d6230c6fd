import { dot, pointOf, turnIn, type Vector } from "@groma/georef";
import { PLANES } from "./clip-roles.js";
import type { Steps } from "./steps.js";
import type { ClipNode, Relation, Volume, VolumeRecord } from "./volume.js";

/** What lies on the inner side of a plane: n · (p − through) ≥ 0, ECEF, n of unit length. */
export interface HalfSpace {
  readonly normal: Vector;
  readonly through: ArrayLike<number>;
}

/** What is common to half-spaces: a box, a slab, or one half-space itself. */
export function halfSpaces(sides: readonly HalfSpace[]): Volume {
  /** Distances are of differences to a point on the plane: right to 1e-9 m anywhere on the globe. */
  const inward = ({ normal, through }: HalfSpace, x: number, y: number, z: number) =>
    dot(normal, [x - through[0], y - through[1], z - through[2]]);
  const toSphere = (x: number, y: number, z: number, radius: number): Relation => {
    let relation: Relation = "in";
    for (const side of sides) {
      const distance = inward(side, x, y, z);
      if (distance < -radius) return "out";
      if (distance < radius) relation = "crossing";
    }
    return relation;
  };
  return {
    contains: (ecef) => sides.every((side) => inward(side, ecef[0], ecef[1], ecef[2]) >= 0),
    toSphere,
    *toNode({ frame, box }: ClipNode): Steps<"in" | "out" | VolumeRecord> {
      // Most nodes lie apart from all sides by more than their size.
      const middle = [0, 1, 2].map((axis) => (box[axis] + box[axis + 3]) / 2) as unknown as Vector;
      const radius = Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]) / 2;
      const rough = toSphere(...pointOf(frame, ...middle), radius);
      if (rough !== "crossing") return rough;
      const texels: number[] = [];
      const [x, y, z] = frame.origin;
      for (const side of sides) {
        const normal = turnIn(frame, ...side.normal);
        const offset = inward(side, x, y, z);
        let here = offset;
        let reach = 0;
        for (let axis = 0; axis < 3; axis++) {
          here += normal[axis] * middle[axis];
          reach += (Math.abs(normal[axis]) * (box[axis + 3] - box[axis])) / 2;
        }
        if (here + reach < 0) return "out";
        if (here - reach < 0) texels.push(...normal, offset);
      }
      return texels.length === 0 ? "in" : { kind: PLANES, count: texels.length / 4, bits: 0, texels };
    },
  };
}

import { planarArea } from "@groma/georef";
import { MeasureError } from "../../../errors/index.js";
import { tooFew } from "../figures/refusals.js";
import { crossingEdges } from "../figures/ring.js";
import { heldAgainst, noSurface, type Progress, type VolumeBase } from "./base.js";
import { checkBase } from "./check-base.js";
import { type CutAndFill, prismsOf } from "./prisms.js";
import { RingIndex } from "./ring-index.js";
import { type Sensitivities, sensitivitiesOf } from "./sensitivity.js";
import { Tin } from "./tin.js";

/** Volumes over a ring. */
export interface RingVolume extends CutAndFill {
  /** Area of the ring, square metres. */
  readonly area: number;
  /** Points of the surface. */
  readonly points: number;
  /** How the net volume changes with the places of all points; worked out when it is asked for. */
  sensitivities(): Sensitivities;
}

/**
 * Volumes between a surface and a base within a ring, prismoidal over Delaunay's triangles: exact for the surface of these
 * triangles. Where the base is made of triangles too, the surface is that of the differences at the points of both.
 *
 * @param points x, y, z of each, metres in one Cartesian plan; points around the ring let the surface reach its edge
 * @param ring x, y, z of its vertices in the same plan
 * @throws MeasureError MEASURE_OPTION for the base; MEASURE_VERTICES, MEASURE_CROSSING for the ring; MEASURE_SURFACE where the points make no surface
 */
export function cutAndFill(
  points: Float64Array,
  ring: Float64Array,
  base: VolumeBase,
  onProgress: Progress = () => undefined,
): RingVolume {
  checkBase(base);
  if (ring.length < 9) throw tooFew("a volume", 3, ring.length / 3);
  const plan = flat(ring);
  const edges = crossingEdges(plan);
  if (edges) {
    throw new MeasureError({
      code: "MEASURE_CROSSING",
      file: "volume",
      cause: `the edges of its ring after vertex ${edges[0] + 1} and after vertex ${edges[1] + 1} cross`,
      fix: "move one of these vertices, or take the vertices in another order",
    });
  }
  const index = new RingIndex(plan, planarArea(plan));
  // Of two surfaces each is triangulated for itself, and then their differences are.
  const begun = base.kind === "surface" ? 0.55 : base.kind === "ring" ? 0.4 : 0;
  const held = heldAgainst(points, ring, base, (share) => onProgress(begun * share));
  const surface = new Tin(held.above);
  if (surface.triangles.length === 0) throw noSurface();
  onProgress(begun + 0.75 * (1 - begun));
  return {
    ...prismsOf(surface, index),
    ...{ area: index.area, points: points.length / 3 },
    sensitivities: () =>
      sensitivitiesOf({ points, ring, kind: base.kind, held, differences: surface, index }),
  };
}

/** x and y alone. */
function flat(ring: Float64Array): Float64Array {
  return Float64Array.from({ length: (ring.length / 3) * 2 }, (_, i) => ring[3 * (i >> 1) + (i & 1)]);
}

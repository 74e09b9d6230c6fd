import { pointIn } from "@groma/georef";
import { groupsOf, insideTest } from "./parity.js";
import { heightIn, type NodePlan } from "./plan-of-node.js";
import type { End, PrismShape } from "./prism.js";
import { capOf, footOf, geodesicRing, placed, sourceRing } from "./rings.js";
import { type Corner, extendedPlace, insideRing, ringOver, sourceOf } from "./source-space.js";
import type { Steps } from "./steps.js";
import type { ClipNode, Place, SourceSpace } from "./volume.js";

/** Heights between which a prism stands; without one it has no end there. */
export interface PrismEnds {
  readonly bottom?: number | undefined;
  readonly top?: number | undefined;
}

/**
 * A prism over a ring of geodesics; heights over the ellipsoid, metres.
 * @param corners that reach no farther than {@link FARTHEST} from their middle
 */
export function* geodeticShape(corners: readonly Corner[], { bottom, top }: PrismEnds): Steps<PrismShape> {
  const ring = yield* geodesicRing(corners);
  const groups = yield* groupsOf(ring);
  const inside = yield* insideTest(ring, groups, capOf(corners).middle);
  const end = (height: number | undefined, plan: NodePlan): End | undefined =>
    height === undefined ? undefined : { height: height - plan.height, slope: [0, 0] };
  return {
    ring,
    groups,
    tilted: false,
    slack: 0,
    contains(ecef) {
      const { foot, height } = footOf(ecef[0], ecef[1], ecef[2]);
      return height >= (bottom ?? height) && height <= (top ?? height) && inside(foot);
    },
    inside: (ecef) => inside(footOf(...ecef).foot),
    bottom: bottom === undefined ? undefined : [bottom, bottom],
    top: top === undefined ? undefined : [top, top],
    bottomOver: (_, plan) => end(bottom, plan),
    topOver: (_, plan) => end(top, plan),
  };
}

/** Metres by which source height 0 may lie off the ellipsoid: geoids do by up to 107 m, datums by some more. */
const SOURCE_SLACK = 500;

/** A prism over a ring that is straight in source coordinates; heights are source z. */
export function* sourceShape(
  corners: readonly Corner[],
  { bottom, top }: PrismEnds,
  space: SourceSpace,
): Steps<PrismShape> {
  const place = extendedPlace(space);
  const over = ringOver(corners, space);
  const ring = yield* sourceRing(over, place);
  const { min, max } = space.boundingBox;
  const middle = [0, 1, 2].map((axis) => (min[axis] + max[axis]) / 2) as [number, number, number];
  const range = (z: number | undefined) => (z === undefined ? undefined : heightsOf(z, place, space));
  return {
    ring,
    groups: yield* groupsOf(ring),
    tilted: true,
    slack: SOURCE_SLACK,
    contains(_, source) {
      const z = source[2];
      return z >= (bottom ?? z) && z <= (top ?? z) && insideRing(corners, source[0], source[1]);
    },
    inside(ecef) {
      const [x, y] = sourceOf(place, ecef, middle);
      return insideRing(corners, x, y);
    },
    bottom: range(bottom),
    top: range(top),
    bottomOver: (node, plan) => endOver(bottom, node, plan, place, middle),
    topOver: (node, plan) => endOver(top, node, plan, place, middle),
  };
}

/** Least and greatest ellipsoidal height at source z over a data set: at a grid of its box. */
function heightsOf(z: number, place: Place, { boundingBox }: SourceSpace): [number, number] {
  const { min, max } = boundingBox;
  let [least, greatest] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const u of [0, 0.25, 0.5, 0.75, 1]) {
    for (const v of [0, 0.25, 0.5, 0.75, 1]) {
      const x = min[0] + u * (max[0] - min[0]);
      const y = min[1] + v * (max[1] - min[1]);
      const { height } = footOf(...placed(place, x, y, z));
      [least, greatest] = [Math.min(least, height), Math.max(greatest, height)];
    }
  }
  const between = (greatest - least) / 4 + 1;
  return [least - between, greatest + between];
}

/** Source z as a height over a node's origin: its value and slope at the middle of the box. */
function endOver(
  z: number | undefined,
  node: ClipNode,
  plan: NodePlan,
  place: Place,
  start: readonly [number, number, number],
): End | undefined {
  if (z === undefined) return undefined;
  const [x, y] = sourceOf(place, plan.centre, start);
  const at = (px: number, py: number) => {
    const local = pointIn(node.frame, ...placed(place, px, py, z));
    return { local, height: heightIn(plan, local) };
  };
  const here = at(x, y);
  const probe = at(x + Math.max(1, Math.abs(x)) * 1e-6, y);
  const metres =
    Math.hypot(probe.local[0] - here.local[0], probe.local[1] - here.local[1]) /
    (Math.max(1, Math.abs(x)) * 1e-6);
  const step = Math.max(1, plan.radius / 2) / metres;
  const [east, north] = [at(x + step, y), at(x, y + step)];
  const [ax, ay] = [east.local[0] - here.local[0], east.local[1] - here.local[1]];
  const [bx, by] = [north.local[0] - here.local[0], north.local[1] - here.local[1]];
  const [da, db] = [east.height - here.height, north.height - here.height];
  const determinant = ax * by - ay * bx;
  const slope = [(da * by - db * ay) / determinant, (ax * db - bx * da) / determinant] as const;
  const height = here.height - slope[0] * here.local[0] - slope[1] * here.local[1];
  return { height, slope };
}

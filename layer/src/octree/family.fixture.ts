import fc from "fast-check";
import { HierarchyPage, type NodeBounds, OctreeNode } from "./octree-node.js";
import type { View } from "./view.js";

/** A camera at the origin that looks along x; the picture is 1000 pixels high and 2 m high at a metre's distance. */
export const view: View = {
  position: [0, 0, 0],
  direction: [1, 0, 0],
  planes: [],
  height: 1000,
  projection: { kind: "perspective", fieldOfView: Math.PI / 2 },
  horizon: false,
};
export const PIXELS_PER_METRE = 500;
export const everything = {
  maximumScreenSpaceError: 1e-9,
  limit: Number.POSITIVE_INFINITY,
  prefix: true,
  rejects: undefined,
};

/** A sphere that may lie anywhere, however little that fits the sphere of its parent. */
export const bounds: fc.Arbitrary<NodeBounds> = fc.record({
  x: fc.double({ min: -500, max: 500, noNaN: true }),
  y: fc.double({ min: -500, max: 500, noNaN: true }),
  z: fc.double({ min: -500, max: 500, noNaN: true }),
  radius: fc.double({ min: 1, max: 100, noNaN: true }),
  spacing: fc.double({ min: 0.01, max: 10, noNaN: true }),
});

/** A root, its eight children and their first children, with the given spheres and points: 1 to 17 × 100. */
export function family(
  spheres: readonly NodeBounds[],
  pointsOf = (index: number) => 100 * (index + 1),
): OctreeNode {
  const node = (index: number, depth: number, x: number, y: number, z: number) => {
    const made = new OctreeNode({ depth, x, y, z }, "listed");
    made.pointCount = pointsOf(index);
    made.bounds = spheres[index];
    return made;
  };
  const root = node(0, 0, 0, 0, 0);
  for (let n = 0; n < 8; n++) {
    const [x, y, z] = [n & 1, (n >> 1) & 1, n >> 2];
    const child = node(1 + n, 1, x, y, z);
    child.adopt(node(9 + n, 2, 2 * x, 2 * y, 2 * z));
    root.adopt(child);
  }
  return root;
}

export const families = fc.array(bounds, { minLength: 17, maxLength: 17 });
export const known = (node: OctreeNode) => node.bounds!;

/**
 * The importance as the docstring of `gather` has it, computed anew: the spacing in pixels, by the place in the picture
 * (1 in the middle, 0.75 beside the camera, 0.5 behind it), at most that of the node above.
 */
export function importance(
  bounds: NodeBounds,
  above: number,
  { position, direction, projection } = view,
): number {
  const { x, y, z, radius, spacing } = bounds;
  const away = [x - position[0], y - position[1], z - position[2]];
  const length = Math.hypot(...away);
  const orthographic = projection.kind === "orthographic";
  if (length <= radius) {
    return Math.min(above, (orthographic ? PIXELS_PER_METRE : 1e12) * spacing);
  }
  const pixels = (PIXELS_PER_METRE * spacing) / (orthographic ? 1 : length - radius);
  const ahead = away.reduce((sum, part, axis) => sum + part * direction[axis], 0) / length;
  return Math.min(above, pixels * (0.5 + (0.5 * (1 + ahead)) / 2));
}

/** How far apart the points of a node with nothing above it lie, in terms of its level's distance. */
export function sparsenessOf({ bounds, pointCount }: OctreeNode): number {
  const area = 2 * bounds!.radius ** 2;
  return Math.max(1, Math.sqrt(area / pointCount) / bounds!.spacing);
}

export function importances(root: OctreeNode, from: View = view): Map<string, number> {
  const all = new Map<string, number>();
  const visit = (node: OctreeNode, above: number) => {
    const own = importance(node.bounds!, above, from);
    all.set(node.name, node === root ? own * sparsenessOf(node) : own);
    for (const child of node.children ?? []) if (child) visit(child, own);
  };
  visit(root, Number.POSITIVE_INFINITY);
  return all;
}

/** Cameras anywhere, that look anywhere; a metre takes as many pixels as in {@link view}. */
export const views: fc.Arbitrary<View> = fc
  .record({
    position: fc.tuple(...[0, 1, 2].map(() => fc.integer({ min: -300, max: 300 }))),
    turn: fc.double({ min: -Math.PI, max: Math.PI, noNaN: true }),
    rise: fc.double({ min: -1.5, max: 1.5, noNaN: true }),
    orthographic: fc.boolean(),
  })
  .map(({ position, turn, rise, orthographic }) => ({
    ...view,
    position,
    direction: [Math.cos(turn) * Math.cos(rise), Math.sin(turn) * Math.cos(rise), Math.sin(rise)],
    ...(orthographic && {
      projection: { kind: "orthographic" as const, extent: view.height / PIXELS_PER_METRE },
    }),
  }));

/** What a node of a family may be, and whether it begins a page. */
export const kinds = fc.array(
  fc.record({
    kind: fc.constantFrom(...new Array(6).fill("points"), "empty", "empty", "page", "opening", "failed"),
    begins: fc.boolean(),
  }),
  { minLength: 17, maxLength: 17 },
);

/** A family of which some nodes are empty, known by their page alone, or failed with it. */
export function mixed(
  spheres: readonly NodeBounds[],
  of: readonly { readonly kind: string; readonly begins: boolean }[],
): OctreeNode {
  const copy = (node: OctreeNode): OctreeNode => {
    // As in `family`: the root, its children, and theirs.
    const { key } = node;
    const at = (depth: number) => (key.x >> depth) + 2 * (key.y >> depth) + 4 * (key.z >> depth);
    const { kind, begins } = of[[0, 1 + at(0), 9 + at(1)][key.depth]];
    const waits = kind === "page" || kind === "opening";
    const made = new OctreeNode(key, waits ? "page" : kind === "empty" ? "empty" : "listed");
    if (kind === "opening") made.become("opening");
    made.pageFailed = kind === "failed";
    made.pointCount = kind === "points" ? node.pointCount : 0;
    made.bounds = node.bounds;
    if (begins) made.page = new HierarchyPage(made, 1);
    for (const child of node.children ?? []) if (child) made.adopt(copy(child));
    return made;
  };
  return copy(family(spheres));
}

import { drawnSpacing, footprint, groundSpacing, type Patch } from "../effects/index.js";
import { type NodeBounds, type OctreeNode, outsideFrustum, type Selection } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import type { FrameCamera } from "./frame-camera.js";

/** Of a node's points: their box in the node's frame, metres, and the map from there to the node's cube. */
type Extents = Readonly<Record<keyof Pick<NodeVertices, "box" | "toCube">, ArrayLike<number>>>;

/** What is known of a node's points once they are here; undefined until then. */
export type VerticesOf = (node: OctreeNode) => (Extents & Pick<NodeVertices, "frame" | "bound">) | undefined;

/** Of a node whose points are not here. */
const NO_BOX: readonly number[] = [];

/** How far apart the points lie where nothing finer is drawn over them. */
export function spacingFacts(
  { view, width }: FrameCamera,
  { nodes, counts, spacings }: Selection,
  verticesOf: VerticesOf,
) {
  const picture = width * view.height;
  const inView = (bounds: NodeBounds) => !outsideFrustum(view, bounds);
  const wanted = new Set(nodes);
  const drawn = nodes.filter((node) => verticesOf(node));
  const all = drawn.length === nodes.length;
  const here = all ? wanted : new Set(drawn);
  const spacing = new Extent();
  const level = new Extent();
  const ground = new Extent();
  const scale = new Extent();
  const patches: Patch[] = [];
  nodes.forEach((node, index) => {
    const { bounds, key, pointCount, children } = node;
    if (!bounds) return;
    const vertices = verticesOf(node);
    const leaf = !children?.some((child) => child !== undefined);
    // No objects spread into another: for a thousand nodes in each frame they would take a millisecond.
    const apart = drawnSpacing({
      key,
      points: pointCount,
      count: counts[index],
      spacing: bounds.spacing,
      // What is not here yet is expected to be as its level says.
      leaf: vertices !== undefined && leaf,
      box: vertices?.box ?? NO_BOX,
    });
    const pixelsPerMetre = spacings[index] / bounds.spacing;
    const octants = vertices ? octantsUnder(vertices) : 1;
    const bare = shareInSight(node, octants, wanted, inView);
    if (bare > 0) {
      level.add(key.depth);
      ground.add(apart);
      if (Number.isFinite(pixelsPerMetre)) {
        scale.add(pixelsPerMetre);
        spacing.add(apart * pixelsPerMetre);
      }
    }
    // Sizes are for what is drawn now.
    if (!vertices) return;
    const share = all ? bare : shareInSight(node, octants, here, inView);
    if (share === 0) return;
    const pixels = Math.min(picture, footprint(vertices.box, bounds.spacing) * pixelsPerMetre ** 2);
    patches.push({ spacing: apart, pixels: share * pixels });
  });
  return {
    spacings: spacing.range,
    levels: level.range,
    groundSpacings: ground.range,
    groundSpacing: groundSpacing(patches),
    pixelsPerMetre: scale.range[1],
  };
}

/**
 * Share of a node in which nothing finer is drawn: of the octants that its points pass, those without a child, and with
 * one that is in view and not drawn. What lies outside the picture is coarse, and nobody sees it.
 * @param octants that its points pass at least
 */
function shareInSight(
  { children = [] }: OctreeNode,
  octants: number,
  drawn: ReadonlySet<OctreeNode>,
  inView: (bounds: NodeBounds) => boolean,
): number {
  let [all, open] = [0, 0];
  for (let octant = 0; octant < children.length; octant++) {
    const child = children[octant];
    if (!child) continue;
    all++;
    if (!drawn.has(child) && (!child.bounds || inView(child.bounds))) open++;
  }
  const bare = Math.max(0, octants - all);
  return (bare + open) / (bare + all);
}

/** Octants of its cube that a surface passes which is as long and as wide as a node's points: 1, 2 or 4. */
function octantsUnder({ box, toCube }: Extents): number {
  const half = 0.5 / Math.sqrt(toCube[0] ** 2 + toCube[1] ** 2 + toCube[2] ** 2);
  let octants = 1;
  for (let axis = 0; axis < 3; axis++) if (box[axis + 3] - box[axis] > half) octants *= 2;
  return Math.min(4, octants);
}

/** Least and greatest of what was added; 0 and 0 where nothing was. */
export class Extent {
  #least = Number.POSITIVE_INFINITY;
  #greatest = Number.NEGATIVE_INFINITY;

  add(value: number): void {
    this.#least = Math.min(this.#least, value);
    this.#greatest = Math.max(this.#greatest, value);
  }

  get range(): readonly [number, number] {
    return this.#least <= this.#greatest ? [this.#least, this.#greatest] : [0, 0];
  }
}

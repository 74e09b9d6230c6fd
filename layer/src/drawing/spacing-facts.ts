import { drawnSpacing, footprint, groundSpacing } from "../effects/index.js";
import { type OctreeNode, outsideFrustum, type Selection } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import type { FrameCamera } from "./frame-camera.js";

/** Of a node's points: their box in the node's frame, metres, and the map from there to the node's cube. */
type Extents = Readonly<Record<keyof Pick<NodeVertices, "box" | "toCube">, ArrayLike<number>>>;

/** What is known of a node's points once they are here. */
export type NodeShape = Extents & Pick<NodeVertices, "frame" | "bound">;

/** Of a node whose points are not here. */
const NO_BOX: readonly number[] = [];

/**
 * How far apart the points lie where nothing finer is drawn over them.
 * @param shapes of the selection's nodes, at the same indices, as far as they are here
 */
export function spacingFacts(
  { view, width }: FrameCamera,
  selection: Selection,
  shapes: readonly (NodeShape | undefined)[],
) {
  const { nodes, counts, spacings } = selection;
  const picture = width * view.height;
  let all = true;
  for (let index = 0; index < nodes.length; index++) {
    nodes[index].index = index;
    if (!shapes[index]) all = false;
  }
  const spacing = new Extent();
  const level = new Extent();
  const ground = new Extent();
  const scale = new Extent();
  const patches = { spacings: new Float64Array(nodes.length), pixels: new Float64Array(nodes.length) };
  let patched = 0;
  for (let index = 0; index < nodes.length; index++) {
    const node = nodes[index];
    const { bounds, key } = node;
    if (!bounds) continue;
    const shape = shapes[index];
    const apart = drawnSpacing({
      key,
      points: node.pointCount,
      count: counts[index],
      spacing: bounds.spacing,
      // What is not here yet is expected to be as its level says.
      leaf: shape !== undefined && isLeaf(node),
      box: shape ? shape.box : NO_BOX,
    });
    const pixelsPerMetre = spacings[index] / bounds.spacing;
    const octants = shape ? octantsUnder(shape) : 1;
    const bare = shareInSight(node, octants, view, nodes, undefined);
    if (bare > 0) {
      level.add(key.depth);
      ground.add(apart);
      if (Number.isFinite(pixelsPerMetre)) {
        scale.add(pixelsPerMetre);
        spacing.add(apart * pixelsPerMetre);
      }
    }
    // Sizes are for what is drawn now.
    if (!shape) continue;
    const share = all ? bare : shareInSight(node, octants, view, nodes, shapes);
    if (share === 0) continue;
    const pixels = footprint(shape.box, bounds.spacing) * pixelsPerMetre * pixelsPerMetre;
    patches.spacings[patched] = apart;
    patches.pixels[patched++] = share * Math.min(picture, pixels);
  }
  return {
    spacings: spacing.range,
    levels: level.range,
    groundSpacings: ground.range,
    groundSpacing: groundSpacing(patches.spacings.subarray(0, patched), patches.pixels.subarray(0, patched)),
    pixelsPerMetre: scale.range[1],
  };
}

/** Whether the data set has no children of a node. */
function isLeaf({ children }: OctreeNode): boolean {
  if (!children) return true;
  for (let octant = 0; octant < children.length; octant++) if (children[octant]) return false;
  return true;
}

/**
 * Share of a node in which nothing finer is drawn: of the octants that its points pass, those without a child, and with
 * one that is in view and not drawn. What lies outside the picture is coarse, and nobody sees it.
 * @param octants that its points pass at least
 * @param nodes that are drawn, each with its index
 * @param shapes where only those of them are drawn that are here
 */
function shareInSight(
  { children }: OctreeNode,
  octants: number,
  view: FrameCamera["view"],
  nodes: readonly OctreeNode[],
  shapes: readonly (NodeShape | undefined)[] | undefined,
): number {
  if (!children) return 1;
  let all = 0;
  let open = 0;
  for (let octant = 0; octant < children.length; octant++) {
    const child = children[octant];
    if (!child) continue;
    all++;
    const { index } = child;
    // Nothing is read beyond the end of an array, which would take longer from then on.
    const listed = index < nodes.length && nodes[index] === child;
    const drawn = listed && (!shapes || shapes[index] !== undefined);
    if (!drawn && (!child.bounds || !outsideFrustum(view, child.bounds))) open++;
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

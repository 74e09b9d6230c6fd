import { footprint, groundSpacing, spacingOf } from "../effects/index.js";
import { type NodeShapes, type OctreeNode, outsideFrustum, type Selection, SHAPE } from "../octree/index.js";
import type { FrameCamera } from "./frame-camera.js";

/** What is here of the nodes of a selection. */
export interface NodesHere {
  /** Their slots in {@link shapes}, at the same indices; below 0 where a node's points are not here. */
  readonly slots: Int32Array;
  readonly shapes: NodeShapes;
}

/**
 * How far apart the points lie where nothing finer is drawn over them.
 * @param here what is here of the selection's nodes
 */
export function spacingFacts(
  { view, width }: FrameCamera,
  selection: Selection,
  { slots, shapes }: NodesHere,
) {
  const { nodes, counts, spacings } = selection;
  const { numbers } = shapes;
  const picture = width * view.height;
  let all = true;
  for (let index = 0; index < nodes.length; index++) {
    nodes[index].index = index;
    if (slots[index] < 0) all = false;
  }
  const spacing = new Extent();
  const level = new Extent();
  const ground = new Extent();
  const scale = new Extent();
  const patches = { spacings: new Float64Array(nodes.length), pixels: new Float64Array(nodes.length) };
  let patched = 0;
  for (let index = 0; index < nodes.length; index++) {
    const node = nodes[index];
    const { bounds, key, pointCount } = node;
    if (!bounds) continue;
    const { spacing: least } = bounds;
    const isHere = slots[index] >= 0;
    const begin = isHere ? shapes.begin(slots[index]) : 0;
    const area = isHere ? footprint(numbers[begin + SHAPE.longest], numbers[begin + SHAPE.middle], least) : 0;
    // What is not here yet is expected to be as its level says.
    const alone = isHere && isLeaf(node) ? area : undefined;
    const apart = spacingOf(key.depth, pointCount, counts[index], least, alone);
    const pixelsPerMetre = spacings[index] / least;
    const octants = isHere ? numbers[begin + SHAPE.octants] : 1;
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
    if (!isHere) continue;
    const share = all ? bare : shareInSight(node, octants, view, nodes, slots);
    if (share === 0) continue;
    const pixels = area * pixelsPerMetre * pixelsPerMetre;
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
 * @param slots where only those of them are drawn that are here
 */
function shareInSight(
  { children }: OctreeNode,
  octants: number,
  view: FrameCamera["view"],
  nodes: readonly OctreeNode[],
  slots: Int32Array | undefined,
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
    const drawn = listed && (!slots || slots[index] >= 0);
    if (!drawn && (!child.bounds || !outsideFrustum(view, child.bounds))) open++;
  }
  const bare = Math.max(0, octants - all);
  return (bare + open) / (bare + all);
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

import type { OctreeNode } from "./octree-node.js";

/** Points of a node as they lie in its frame. */
export interface ShapedPoints {
  /** Least and greatest position in the node's frame: min x, y, z, max x, y, z, metres. */
  readonly box: ArrayLike<number>;
  /** Affine map, 3 rows of 4: node frame → the node's cube, 0 to 1 on each axis. */
  readonly toCube: ArrayLike<number>;
  /** Node frame → ECEF, or map. */
  readonly frame: { readonly rotation: ArrayLike<number>; readonly origin: ArrayLike<number> };
  /** Certified distance of a stored position from its exact place, metres. */
  readonly bound: number;
  /** Length that positions are stored in whole multiples of, metres; undefined where they are float32. */
  readonly step?: number | undefined;
  /** How the node is placed. */
  readonly scheme?: string | undefined;
}

/** Numbers of each shape. */
const WIDTH = 12;

/** What the numbers of a shape are, by their place among them. */
export const SHAPE = {
  /** Octants of its cube that a surface passes which is as long and as wide as the points: 1, 2 or 4. */
  octants: 0,
  /** The two longer sides of the box, the longer one first, metres. */
  longest: 1,
  middle: 2,
  /** Greatest coordinate of the box, whatever its sign, metres. */
  reach: 3,
  /** Sum of the squares of the greatest coordinates of the box on each axis, square metres. */
  reachSquared: 4,
  bound: 5,
  /** 0 where positions are float32. */
  step: 6,
  /** Index in {@link NodeShapes.schemes}. */
  scheme: 7,
  /** Origin of the frame, x, y and z: ECEF, or map, metres. */
  origin: 8,
} as const;

/**
 * What frames ask of the points of each node again and again, in one array of numbers: a view that moves goes through those of a
 * thousand nodes in each frame, and numbers in as many objects would have to be fetched from all over the memory. A node whose
 * points are here has a slot, which it knows itself.
 */
export class NodeShapes<Points extends ShapedPoints = ShapedPoints> {
  readonly #points: (Points | undefined)[] = [];
  readonly #schemes: string[] = [];
  /** Slots that no node has. */
  readonly #free: number[] = [];
  /** Whether the numbers of a slot are those of its points: they are formed when they are first asked for. */
  readonly #formed: boolean[] = [];
  #numbers = new Float64Array(64 * WIDTH);

  /** The numbers of all slots; another array once there are more nodes. */
  get numbers(): Float64Array {
    return this.#numbers;
  }

  /** Names of the ways in which nodes are placed. */
  get schemes(): readonly string[] {
    return this.#schemes;
  }

  /** First number of a slot. */
  begin(slot: number): number {
    return WIDTH * slot;
  }

  /** The points of a slot; undefined below 0. */
  points(slot: number): Points | undefined {
    return slot < 0 ? undefined : this.#points[slot];
  }

  /** Takes note of a node's points, which are here from now on. */
  add(node: OctreeNode, points: Points): void {
    if (node.slot < 0) node.slot = this.#free.pop() ?? this.#points.length;
    const { slot } = node;
    this.#points[slot] = points;
    this.#formed[slot] = false;
    if (WIDTH * (slot + 1) > this.#numbers.length) {
      const before = this.#numbers;
      this.#numbers = new Float64Array(2 * before.length);
      this.#numbers.set(before);
    }
  }

  /** The slot of a node, whose numbers are there from then on; below 0 where its points are not here. */
  slotOf({ slot }: OctreeNode): number {
    if (slot < 0 || this.#formed[slot]) return slot;
    const points = this.#points[slot];
    if (points) this.#form(WIDTH * slot, points);
    this.#formed[slot] = true;
    return slot;
  }

  /** Forgets a node, whose points are given up. */
  remove(node: OctreeNode): void {
    const { slot } = node;
    if (slot < 0) return;
    this.#points[slot] = undefined;
    this.#free.push(slot);
    node.slot = -1;
  }

  #form(begin: number, { box, toCube, frame, bound, step = 0, scheme = "" }: Points): void {
    const numbers = this.#numbers;
    const half = 0.5 / Math.sqrt(toCube[0] ** 2 + toCube[1] ** 2 + toCube[2] ** 2);
    const sides: number[] = [];
    let octants = 1;
    let reach = 0;
    let squares = 0;
    for (let axis = 0; axis < 3; axis++) {
      const [low, high] = [box[axis], box[axis + 3]];
      const farthest = Math.max(Math.abs(low), Math.abs(high));
      sides.push(high - low);
      if (high - low > half) octants *= 2;
      reach = Math.max(reach, farthest);
      squares += farthest * farthest;
      numbers[begin + SHAPE.origin + axis] = frame.origin[axis];
    }
    sides.sort((a, b) => b - a);
    numbers[begin + SHAPE.octants] = Math.min(4, octants);
    numbers[begin + SHAPE.longest] = sides[0];
    numbers[begin + SHAPE.middle] = sides[1];
    numbers[begin + SHAPE.reach] = reach;
    numbers[begin + SHAPE.reachSquared] = squares;
    numbers[begin + SHAPE.bound] = bound;
    numbers[begin + SHAPE.step] = step;
    if (!this.#schemes.includes(scheme)) this.#schemes.push(scheme);
    numbers[begin + SHAPE.scheme] = this.#schemes.indexOf(scheme);
  }
}

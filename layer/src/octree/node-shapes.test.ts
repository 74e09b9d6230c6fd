import { expect, it } from "vitest";
import { NodeShapes, SHAPE } from "./node-shapes.js";
import { OctreeNode } from "./octree-node.js";

const node = (x: number) => new OctreeNode({ depth: 9, x, y: 0, z: 0 }, "listed");

/** Points in a box of 8 × 2 × 3 m, of a cube of 10 m. */
const points = (scheme = "affine", step?: number) => ({
  box: [-1, -5, 0, 7, -3, 3],
  toCube: [0.1, 0, 0, 0, 0, 0.1, 0, 0, 0, 0, 0.1, 0],
  frame: { origin: [10, 20, 30], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] },
  ...{ bound: 1e-3, step, scheme },
});

/** All numbers of a node, by their names. */
function numbersOf(shapes: NodeShapes, of: OctreeNode): Record<string, number> {
  const begin = shapes.begin(shapes.slotOf(of));
  return Object.fromEntries(Object.entries(SHAPE).map(([name, at]) => [name, shapes.numbers[begin + at]!]));
}

it("says of points how they lie in their frame, and where that is", () => {
  const shapes = new NodeShapes();
  const [one, other] = [node(0), node(1)];
  shapes.add(one, points());
  shapes.add(other, points("cubic", 0.25));
  expect(numbersOf(shapes, one)).toEqual({
    // Longer than half of the cube on one axis only.
    ...{ octants: 2, longest: 8, middle: 3 },
    ...{ reach: 7, reachSquared: 49 + 25 + 9 },
    ...{ bound: 1e-3, step: 0, scheme: 0, origin: 10 },
  });
  expect(numbersOf(shapes, other)).toMatchObject({ step: 0.25, scheme: 1 });
  expect(shapes.schemes).toEqual(["affine", "cubic"]);
});

it("keeps the numbers of nodes however many there are, and gives the slots of those that are gone to others", () => {
  const shapes = new NodeShapes();
  const nodes = Array.from({ length: 200 }, (_, x) => node(x));
  for (const [index, one] of nodes.entries()) shapes.add(one, points("affine", index + 1));
  for (const [index, one] of nodes.entries()) expect(numbersOf(shapes, one).step).toBe(index + 1);
  const [first] = nodes as [OctreeNode];
  const { slot } = first;
  shapes.remove(first);
  shapes.remove(first);
  expect([first.slot, shapes.points(first.slot), shapes.points(slot)]).toEqual([-1, undefined, undefined]);
  const [next, last] = [node(1000), node(1001)];
  shapes.add(next, points("affine", 1000));
  shapes.add(last, points("affine", 1001));
  expect([next.slot, last.slot]).toEqual([slot, 200]);
  expect(numbersOf(shapes, next).step).toBe(1000);
});

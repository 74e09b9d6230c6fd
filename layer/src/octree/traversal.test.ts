import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { type NodeBounds, OctreeNode } from "./octree-node.js";
import { selectNodes } from "./traversal.js";
import type { View } from "./view.js";
import type { VoxelKey } from "./voxel-key.js";

/** Metres of the root's edge; the octree's corner is at the origin of ECEF, where nothing has a horizon. */
const EDGE = 1000;

function tree(depth: number, points = 100, key: VoxelKey = { depth: 0, x: 0, y: 0, z: 0 }): OctreeNode {
  const node = new OctreeNode(key, "listed");
  node.pointCount = points;
  if (key.depth === depth) return node;
  for (let n = 0; n < 8; n++) {
    const child = {
      depth: key.depth + 1,
      x: 2 * key.x + (n & 1),
      y: 2 * key.y + ((n >> 1) & 1),
      z: 2 * key.z + (n >> 2),
    };
    node.adopt(tree(depth, points, child));
  }
  return node;
}

function boundsOf({ key }: OctreeNode): NodeBounds {
  const edge = EDGE / 2 ** key.depth;
  const middle = (index: number) => (index + 0.5) * edge;
  return {
    ...{ x: middle(key.x), y: middle(key.y), z: middle(key.z) },
    ...{ radius: (edge * Math.sqrt(3)) / 2, spacing: edge / 100 },
  };
}

function viewFrom(x: number, planes: number[] = []): View {
  return {
    position: [x, EDGE / 2, EDGE / 2],
    direction: [1, 0, 0],
    planes,
    height: 1000,
    projection: { kind: "perspective", fieldOfView: Math.PI / 2 },
    horizon: false,
  };
}

const options = { maximumScreenSpaceError: 2, pointBudget: 1e9 };
const parent = ({ key }: OctreeNode) => `${key.depth - 1}-${key.x >> 1}-${key.y >> 1}-${key.z >> 1}`;

describe("selectNodes", () => {
  it("takes the root alone from far away, and everything from within", () => {
    expect(selectNodes(tree(3), viewFrom(-1e6), options, boundsOf).nodes.map((n) => n.name)).toEqual([
      "0-0-0-0",
    ]);
    const near = selectNodes(
      tree(2),
      viewFrom(EDGE / 2),
      { ...options, maximumScreenSpaceError: 0.1 },
      boundsOf,
    );
    expect(near.nodes).toHaveLength(1 + 8 + 64);
  });

  it("refines as the camera comes nearer or the error is held smaller", () => {
    const count = (x: number, maximumScreenSpaceError: number) =>
      selectNodes(tree(3), viewFrom(x), { ...options, maximumScreenSpaceError }, boundsOf).nodes.length;
    expect(count(-500, 2)).toBeGreaterThan(count(-3000, 2));
    expect(count(-3000, 1)).toBeGreaterThan(count(-3000, 4));
  });

  it("never passes the budget, and names each node after its parent", () => {
    const root = tree(3);
    fc.assert(
      fc.property(
        fc.integer({ min: 0, max: 60_000 }),
        fc.integer({ min: -2000, max: 1000 }),
        (pointBudget, x) => {
          const choice = selectNodes(root, viewFrom(x), { ...options, pointBudget }, boundsOf);
          const { nodes, counts, points, limited } = choice;
          expect(points).toBeLessThanOrEqual(pointBudget);
          // To the last point, where it is the budget that ends it.
          if (limited) expect(points).toBe(pointBudget);
          expect(points).toBe(counts.reduce((sum, count) => sum + count, 0));
          expect(counts.every((count, index) => count >= 1 && count <= nodes[index].pointCount)).toBe(true);
          const seen = new Set<string>();
          const orphans = nodes.filter((node) => {
            seen.add(node.name);
            return node.key.depth > 0 && !seen.has(parent(node));
          });
          expect(orphans).toEqual([]);
        },
      ),
    );
  });

  it("says whether the budget ended it", () => {
    expect(selectNodes(tree(2), viewFrom(-500), { ...options, pointBudget: 500 }, boundsOf).limited).toBe(
      true,
    );
    expect(selectNodes(tree(2), viewFrom(-500), options, boundsOf).limited).toBe(false);
  });

  it("spends the budget where points are largest on the screen: near the camera", () => {
    const { nodes } = selectNodes(tree(3), viewFrom(-200), { ...options, pointBudget: 3000 }, boundsOf);
    const deepest = nodes.filter((node) => node.key.depth === 3);
    expect(deepest.length).toBeGreaterThan(0);
    expect(Math.max(...deepest.map((node) => node.key.x))).toBeLessThan(4);
  });

  it("leaves out what lies outside the frustum, with all below it", () => {
    // Inside is x ≤ 100.
    const { nodes } = selectNodes(tree(2), viewFrom(-200, [-1, 0, 0, 100]), options, boundsOf);
    expect(nodes.map((node) => node.name)).toContain("2-0-0-0");
    expect(nodes.some((node) => node.key.depth === 2 && node.key.x >= 2)).toBe(false);
  });

  it("asks for nothing that the earth hides, and for all of it where the globe is not drawn", () => {
    const earth = 6_378_137;
    const sphere = (x: number, radius: number): NodeBounds => ({ x, y: 0, z: 0, radius, spacing: 1e5 });
    const spheres = new Map([
      ["0-0-0-0", sphere(0, 1.2 * earth)],
      ["1-0-0-0", sphere(earth, 1000)],
      ["1-1-0-0", sphere(-earth, 1000)],
      ["1-0-1-0", sphere(-earth, 1000)],
    ]);
    const root = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "listed");
    root.pointCount = 100;
    for (const key of [
      { depth: 1, x: 0, y: 0, z: 0 },
      { depth: 1, x: 1, y: 0, z: 0 },
    ]) {
      root.adopt(tree(1, 100, key));
    }
    root.adopt(new OctreeNode({ depth: 1, x: 0, y: 1, z: 0 }, "page"));
    const view: View = { ...viewFrom(0), position: [2 * earth, 0, 0], direction: [-1, 0, 0] };
    const choose = (horizon: boolean) =>
      selectNodes(root, { ...view, horizon }, options, (node) => spheres.get(node.name)!);
    expect(choose(true).nodes.map(({ name }) => name)).toEqual(["0-0-0-0", "1-0-0-0"]);
    expect(choose(true).pages).toEqual([]);
    expect(choose(false).nodes.map(({ name }) => name)).toEqual(["0-0-0-0", "1-0-0-0", "1-1-0-0"]);
    expect(choose(false).pages.map(({ name }) => name)).toEqual(["1-0-1-0"]);
  });

  it("asks for pages instead of nodes where the hierarchy is not read yet", () => {
    const root = tree(1);
    root.adopt(new OctreeNode({ depth: 1, x: 0, y: 0, z: 0 }, "page"));
    const { nodes, pages } = selectNodes(root, viewFrom(-300), options, boundsOf);
    expect(pages.map((node) => node.name)).toEqual(["1-0-0-0"]);
    expect(nodes).toHaveLength(8);
  });

  it("goes through nodes without points of their own", () => {
    const root = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "empty");
    root.adopt(tree(1, 100, { depth: 1, x: 1, y: 1, z: 1 }));
    expect(selectNodes(root, viewFrom(-300), options, boundsOf).nodes.map((n) => n.name)).toEqual([
      "1-1-1-1",
    ]);
  });

  it("asks for each node's bounds once", () => {
    const root = tree(2);
    let asked = 0;
    const counting = (node: OctreeNode) => {
      asked++;
      return boundsOf(node);
    };
    selectNodes(root, viewFrom(-300), options, counting);
    const first = asked;
    selectNodes(root, viewFrom(-300), options, counting);
    expect(asked).toBe(first);
  });

  it("draws whole nodes or none of them where it is told to, and passes no budget", () => {
    const whole = { ...options, pointBudget: 1050, prefix: false };
    const { nodes, counts, points } = selectNodes(tree(3), viewFrom(-500), whole, boundsOf);
    expect([nodes.length, points]).toEqual([10, 1000]);
    expect(counts.every((count) => count === 100)).toBe(true);
  });

  it("brings the picture to one density: that of the screen-space error", () => {
    const root = tree(4, 10_000);
    fc.assert(
      fc.property(fc.double({ min: -40_000, max: -2500, noNaN: true }), (x) => {
        const error = 2;
        const { nodes, counts, spacings } = selectNodes(root, viewFrom(x), options, boundsOf);
        // Points per square pixel of the levels above a node and of its own share; whole levels below the last.
        const levels = new Map<number, { share: number; spacing: number }>();
        nodes.forEach(({ key }, index) => {
          levels.set(key.depth, { share: counts[index] / 10_000, spacing: spacings[index] });
        });
        const deepest = Math.max(...levels.keys());
        const { share, spacing } = levels.get(deepest)!;
        const above = deepest === 0 ? 0 : 1 / (2 * spacing) ** 2;
        const density = above + share * (1 / spacing ** 2 - above);
        // All is as near as its level says but for the depth of the cube: nearer parts show a little more.
        if (deepest < 4) expect(density * error ** 2).toBeGreaterThan(0.5);
        if (deepest < 4) expect(density * error ** 2).toBeLessThan(2);
      }),
    );
  });

  it("changes by little where the camera moves by little, with and without a budget", () => {
    const root = tree(4, 10_000);
    for (const pointBudget of [1e9, 300_000]) {
      const pointsAt = (x: number) =>
        selectNodes(root, viewFrom(x), { ...options, pointBudget }, boundsOf).points;
      for (let x = -30_000; x < -1500; x += 150) {
        const [here, there] = [pointsAt(x), pointsAt(x + 1)];
        expect(Math.abs(there - here) / here).toBeLessThan(0.02);
      }
    }
  });

  it("asks for nothing that is rejected, nor for what is below", () => {
    const rejects = ({ x }: NodeBounds) => x > EDGE / 2;
    const reached: string[] = [];
    const root = tree(2);
    const { nodes } = selectNodes(root, viewFrom(-300), { ...options, rejects }, (node) => {
      reached.push(node.name);
      return boundsOf(node);
    });
    expect(nodes.some(({ key }) => key.depth === 1)).toBe(true);
    expect(nodes.filter(({ key }) => key.depth > 0 && key.x >= 2 ** (key.depth - 1))).toEqual([]);
    expect(reached.filter((name) => name.startsWith("2-2") || name.startsWith("2-3"))).toEqual([]);
  });

  it("shows a far data set by one point at least, and one whose upper levels are empty", () => {
    expect(selectNodes(tree(1), viewFrom(-1e9), options, boundsOf).counts).toEqual([1]);
    const root = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "empty");
    root.adopt(tree(1, 100, { depth: 1, x: 1, y: 1, z: 1 }));
    expect(selectNodes(root, viewFrom(-1e9), options, boundsOf).counts).toEqual([1]);
  });

  it("shows a far part that nothing is above, however much is near", () => {
    const root = tree(5, 1000);
    root.pointCount = 0;
    const far = root.children!.filter((child) => child!.key.x === 1).map((child) => child!.name);
    const { nodes, counts, limited } = selectNodes(
      root,
      viewFrom(-20),
      { ...options, pointBudget: 8000 },
      boundsOf,
    );
    const drawn = new Map(nodes.map((node, index) => [node.name, counts[index]]));
    expect(limited).toBe(true);
    // Not whole, for what is near comes first.
    for (const name of far) {
      expect(drawn.get(name)).toBeGreaterThan(0);
      expect(drawn.get(name)).toBeLessThan(250);
    }
  });

  it("names as fringe what is too small by little, and nothing else", () => {
    const root = tree(1);
    const [, child] = selectNodes(root, viewFrom(-2000), options, boundsOf).spacings;
    const choose = (error: number) =>
      selectNodes(root, viewFrom(-2000), { ...options, maximumScreenSpaceError: error }, boundsOf);
    expect(choose(1.9 * child).fringe).toHaveLength(0);
    expect(choose(2.1 * child).fringe.length).toBeGreaterThan(0);
    expect(choose(2.1 * child).nodes).toHaveLength(1);
    expect(choose(4 * child).fringe).toHaveLength(0);
  });
});

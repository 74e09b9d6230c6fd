import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { FRINGE, gather } from "./demand.js";
import { type NodeBounds, OctreeNode } from "./octree-node.js";
import { thresholdFor } from "./share.js";
import { SharedBudget } from "./shared-budget.js";
import { selectNodes } from "./traversal.js";
import type { View } from "./view.js";

/** A camera at the origin that looks along x; the picture is 1000 pixels high and 2 m high at a metre's distance. */
const view: View = {
  position: [0, 0, 0],
  direction: [1, 0, 0],
  planes: [],
  height: 1000,
  projection: { kind: "perspective", fieldOfView: Math.PI / 2 },
  horizon: false,
};
const PIXELS_PER_METRE = 500;
const everything = {
  maximumScreenSpaceError: 1e-9,
  limit: Number.POSITIVE_INFINITY,
  prefix: true,
  rejects: undefined,
};

/** A sphere that may lie anywhere, however little that fits the sphere of its parent. */
const bounds: fc.Arbitrary<NodeBounds> = fc.record({
  x: fc.double({ min: -500, max: 500, noNaN: true }),
  y: fc.double({ min: -500, max: 500, noNaN: true }),
  z: fc.double({ min: -500, max: 500, noNaN: true }),
  radius: fc.double({ min: 1, max: 100, noNaN: true }),
  spacing: fc.double({ min: 0.01, max: 10, noNaN: true }),
});

/** A root, its eight children and their first children, with the given spheres and 1 to 17 × 100 points. */
function family(spheres: readonly NodeBounds[]): OctreeNode {
  const node = (index: number, depth: number, x: number, y: number, z: number) => {
    const made = new OctreeNode({ depth, x, y, z }, "listed");
    made.pointCount = 100 * (index + 1);
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

const families = fc.array(bounds, { minLength: 17, maxLength: 17 });
const known = (node: OctreeNode) => node.bounds!;

/**
 * The importance as the docstring of `gather` has it, computed anew: the spacing in pixels, by the place in the picture
 * (1 in the middle, 0.75 beside the camera, 0.5 behind it), at most that of the node above.
 */
function importance({ x, y, z, radius, spacing }: NodeBounds, above: number): number {
  const length = Math.hypot(x, y, z);
  if (length <= radius) return Math.min(above, 1e12 * spacing);
  const pixels = (PIXELS_PER_METRE * spacing) / (length - radius);
  return Math.min(above, pixels * (0.5 + (0.5 * (1 + x / length)) / 2));
}

function importances(root: OctreeNode): Map<string, number> {
  const all = new Map<string, number>();
  const visit = (node: OctreeNode, above: number) => {
    const own = importance(node.bounds!, above);
    all.set(node.name, own);
    for (const child of node.children ?? []) if (child) visit(child, own);
  };
  visit(root, Number.POSITIVE_INFINITY);
  return all;
}

describe("gather", () => {
  it("ranks nodes by their spacing on the screen and their place in it, none above its parent", () => {
    fc.assert(
      fc.property(families, (spheres) => {
        const root = family(spheres);
        const expected = importances(root);
        const { nodes, demand } = gather(root, view, everything, known);
        expect(nodes).toHaveLength(17);
        nodes.forEach((node, index) => {
          const wanted = expected.get(node.name)!;
          expect(Math.abs(demand.pixels[index] - wanted)).toBeLessThanOrEqual(1e-9 * wanted);
          if (index > 0) expect(demand.pixels[index]).toBeLessThanOrEqual(demand.pixels[index - 1]);
        });
      }),
    );
  });

  it("ranks a node in the middle above one beside the camera, and that above one behind it", () => {
    const at = (x: number, y: number): NodeBounds => ({ x, y, z: 0, radius: 10, spacing: 1 });
    const root = family([
      { ...at(0, 0), spacing: 10 },
      ...[at(100, 0), at(0, 100), at(-100, 0)],
      ...new Array(13).fill(at(400, 0)),
    ]);
    const { nodes, demand } = gather(root, view, everything, known);
    const pixels = new Map(nodes.map((node, index) => [node.name, demand.pixels[index]]));
    const whole = PIXELS_PER_METRE / 90;
    expect(pixels.get("1-0-0-0")).toBeCloseTo(whole, 9);
    expect(pixels.get("1-1-0-0")).toBeCloseTo(0.75 * whole, 9);
    expect(pixels.get("1-0-1-0")).toBeCloseTo(0.5 * whole, 9);
  });

  it("gathers all that a limit lets through, and tells the same threshold as if it had gathered everything", () => {
    fc.assert(
      fc.property(families, fc.integer({ min: 1, max: 15_000 }), (spheres, limit) => {
        const whole = gather(family(spheres), view, everything, known);
        const part = gather(family(spheres), view, { ...everything, limit }, known);
        const [wanted, found] = [whole, part].map(({ demand }) => thresholdFor([demand], limit));
        expect(Math.abs(found - wanted)).toBeLessThanOrEqual(1e-6 * wanted);
      }),
    );
  });

  it("does not go below nodes that a limit cannot let through", () => {
    const deep = (depth: number): OctreeNode => {
      const node = new OctreeNode({ depth, x: 0, y: 0, z: 0 }, "listed");
      node.pointCount = 1000;
      node.bounds = { x: 200, y: 0, z: 0, radius: 10, spacing: 2 ** -depth };
      if (depth < 12) node.adopt(deep(depth + 1));
      return node;
    };
    const { nodes } = gather(deep(0), view, { ...everything, limit: 2500 }, known);
    expect(nodes.length).toBeGreaterThanOrEqual(3);
    expect(nodes.length).toBeLessThanOrEqual(6);
  });
});

describe("the fringe of a selection that the budget ends", () => {
  /** A whole octree of three levels over a cube of 200 m, 100 points a node. */
  function regular(depth: number, x: number, y: number, z: number): OctreeNode {
    const node = new OctreeNode({ depth, x, y, z }, "listed");
    const edge = 200 / 2 ** depth;
    node.pointCount = 100;
    node.bounds = {
      ...{ x: 150 + (x + 0.5) * edge, y: (y + 0.3) * edge, z: (z + 0.2) * edge },
      ...{ radius: edge, spacing: edge / 100 },
    };
    if (depth === 3) return node;
    for (let n = 0; n < 8; n++) {
      node.adopt(regular(depth + 1, 2 * x + (n & 1), 2 * y + ((n >> 1) & 1), 2 * z + (n >> 2)));
    }
    return node;
  }

  it("holds nodes left out that are less than a tenth too small, and none that are smaller", () => {
    const root = regular(0, 0, 0, 0);
    const doubled = new Map([...importances(root)].map(([name, size]) => [name, 2 * size]));
    let [near, far] = [0, 0];
    for (let pointBudget = 150; pointBudget < 50_000; pointBudget = Math.ceil(1.05 * pointBudget)) {
      // Two views of the same octree share the points, so that each gathers more than it may draw.
      const budget = new SharedBudget({ points: pointBudget });
      const options = { maximumScreenSpaceError: 1e-9, pointBudget, budget };
      const viewers = [{}, {}];
      const ask = (viewer: object) => selectNodes(root, view, options, known, viewer);
      ask(viewers[0]);
      ask(viewers[1]);
      ask(viewers[0]);
      const { nodes, fringe } = ask(viewers[1]);
      const drawn = new Set(nodes.map(({ name }) => name));
      const hidden = [...doubled].filter(([name]) => !drawn.has(name));
      // The largest node left out is at most 1.5 % above the threshold: of its 100 points none was due.
      const least = Math.max(...hidden.map(([, size]) => size));
      const smallest = Math.min(...fringe.map(({ name }) => doubled.get(name)!));
      expect(smallest).toBeGreaterThan((FRINGE * least) / 1.015);
      near += fringe.length;
      far += hidden.filter(([, size]) => size < FRINGE * least).length;
    }
    expect(near).toBeGreaterThan(100);
    expect(far).toBeGreaterThan(100);
  });
});

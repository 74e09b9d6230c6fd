import { describe, expect, it } from "vitest";
import { OctreeNode, type Selection, type ShapedPoints, type VoxelKey } from "../octree/index.js";
import { nodesHere } from "../octree/nodes-here.fixture.js";
import type { FrameCamera } from "./frame-camera.js";
import { sceneFacts } from "./scene-facts.js";

const HALF = Math.SQRT1_2;

/** A view along x from the origin, 90° wide, 100 × 100 pixels: 50 pixels per metre a metre away. */
const camera: FrameCamera = {
  view: {
    position: [0, 0, 0],
    direction: [1, 0, 0],
    planes: [
      ...[HALF, HALF, 0, 0, HALF, -HALF, 0, 0],
      ...[HALF, 0, HALF, 0, HALF, 0, -HALF, 0],
      ...[1, 0, 0, -0.1, -1, 0, 0, 1000],
    ],
    height: 100,
    projection: { kind: "perspective", fieldOfView: Math.PI / 2 },
    horizon: false,
  },
  width: 100,
  pixelRatio: 1,
  near: 0.1,
  depth: { own: true, scene: true },
  pose: () => [],
};

/** Axes as they are, about a place. */
const frameAt = (origin: [number, number, number]) => ({
  ...{ origin: Float64Array.from(origin), rotation: Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1) },
});

/** A node of 100 points at a place, as far apart as its level says. */
function nodeAt(key: VoxelKey, [x, y, z]: readonly [number, number, number], radius: number): OctreeNode {
  const node = new OctreeNode(key, "listed");
  node.pointCount = 100;
  node.bounds = { x, y, z, radius, spacing: 1.6 / 2 ** key.depth };
  return node;
}

const keys = [0, 1, 2, 3].map((octant) => ({ depth: 1, x: octant & 1, y: octant >> 1, z: 0 }));

/** A square of 16 m across the view at 20 m with four children, of which two lie outside the picture. */
function square() {
  const root = nodeAt({ depth: 0, x: 0, y: 0, z: 0 }, [20, 12, 0], 11);
  const children = keys.map((key) => nodeAt(key, [20, key.x ? 30 : 12, key.y ? 4 : -4], 5));
  for (const child of children) root.adopt(child);
  return { root, children };
}

const layer = {
  ...{ attributes: [], clips: 0, highlights: 0 },
  ...{ filter: undefined, silhouettes: undefined, placing: undefined },
};
/** Points that fill their cubes, as flat as a floor. */
function verticesOf({ key: { depth } }: OctreeNode) {
  const edge = 16 / 2 ** depth;
  const toCube = [1 / edge, 0, 0, 0, 0, 1 / edge, 0, 0, 0, 0, 1 / edge, 0];
  return { box: [0, 0, 0, edge, edge, 1], toCube, bound: 1e-3, frame: frameAt([20, 0, 0]) };
}

function factsOf(
  nodes: OctreeNode[],
  counts: number[],
  spacings: number[],
  of: (node: OctreeNode) => ShapedPoints | undefined = verticesOf,
) {
  const selection: Selection = {
    ...{
      nodes,
      counts,
      spacings,
      worth: nodes.map(() => true),
      pages: [],
      open: [],
      fringe: [],
      limited: false,
    },
    points: counts.reduce((sum, count) => sum + count, 0),
  };
  return sceneFacts(camera, selection, nodesHere(nodes, nodes.map(of)), layer);
}

describe("what is known of the spacing", () => {
  it("leaves out a node whose children in view are all drawn", () => {
    const { root, children } = square();
    const facts = factsOf([root, children[0]!, children[2]!], [100, 100, 100], [4, 2, 2]);
    expect(facts.levels).toEqual([1, 1]);
    expect(facts.pixelsPerMetre).toBe(2 / 0.8);
    // 100 points on 64 m² and a quarter as many per area, as 1.6 m stands for, of the level above.
    const apart = 1 / Math.sqrt(100 / 64 + 1 / 1.6 ** 2);
    expect(facts.groundSpacing).toBeCloseTo(apart, 9);
    expect(facts.spacings[1]).toBeCloseTo((2 / 0.8) * apart, 9);
  });

  it("counts a node where a child that is in view is not drawn, and by what is drawn of it", () => {
    const { root, children } = square();
    const facts = factsOf([root, children[0]!], [25, 100], [4, 2]);
    expect(facts.levels).toEqual([0, 1]);
    expect(facts.groundSpacings[1]).toBeCloseTo(3.2, 9);
    // A root has nothing above it: a quarter of its points lie twice as far apart.
    expect(facts.spacings[1]).toBeCloseTo(8, 9);
  });

  it("counts a node where its points go beyond its children", () => {
    const { root, children } = square();
    root.children![1] = undefined;
    root.children![3] = undefined;
    const facts = factsOf([root, children[0]!, children[2]!], [100, 100, 100], [4, 2, 2]);
    expect(facts.levels).toEqual([0, 1]);
    expect(facts.groundSpacings[1]).toBe(1.6);
  });

  it("takes the size on the ground from what is here, and the rest from what is wanted", () => {
    const { root, children } = square();
    const nodes = [root, children[0]!, children[2]!];
    const rootOnly = (node: OctreeNode) => (node === root ? verticesOf(node) : undefined);
    const facts = factsOf(nodes, [100, 100, 100], [4, 2, 2], rootOnly);
    expect([facts.groundSpacing, facts.levels]).toEqual([1.6, [1, 1]]);
    expect(factsOf([], [], []).groundSpacing).toBe(0);
  });

  it("goes by its own list of nodes, whatever lists of other views have them too", () => {
    const { root, children } = square();
    const [first, , second] = children as [OctreeNode, OctreeNode, OctreeNode, OctreeNode];
    const own = () => factsOf([root, first], [25, 100], [4, 2]);
    const alone = own();
    factsOf([second, first, root], [100, 100, 100], [2, 2, 4]);
    expect(own()).toEqual(alone);
    expect(factsOf([first], [100], [2]).levels).toEqual([1, 1]);
    expect(factsOf([root], [100], [4]).levels).toEqual([0, 0]);
  });

  it("says nothing of pixels around the camera", () => {
    const { root, children } = square();
    const facts = factsOf([root, children[0]!], [100, 100], [Number.POSITIVE_INFINITY, 2]);
    expect(facts.spacings[1]).toBeLessThan(4);
    expect(facts.groundSpacing).toBeGreaterThan(0);
  });
});

it("tells how far away nodes begin: from the camera, or ahead of it where nothing shrinks with distance", () => {
  const nodes = [nodeAt({ depth: 0, x: 0, y: 0, z: 0 }, [30, 40, 0], 10), nodeAt(keys[0]!, [5, 0, 0], 10)];
  const selection = { nodes, counts: [100, 100], spacings: [2, 2], points: 200 } as unknown as Selection;
  const nearest = (seen: FrameCamera) => {
    const told = new Float32Array(2);
    sceneFacts(seen, selection, nodesHere(nodes, nodes.map(verticesOf)), layer, told);
    return [...told];
  };
  const near = Math.fround(0.1);
  expect(nearest(camera)).toEqual([40, near]);
  const flat = { ...camera.view, projection: { kind: "orthographic", extent: 100 } as const };
  expect(nearest({ ...camera, view: flat })).toEqual([20, near]);
});

describe("what a point may be off on screen", () => {
  const node = nodeAt({ depth: 0, x: 0, y: 0, z: 0 }, [20, 0, 0], 10);
  /** Of a node that is as wide as `half` says on each side of x = 20 and lies from z = -5 down, in view from the origin. */
  const pixels = (half: number, bound: number, at: [number, number, number] = [20, 0, 0]) => {
    const box = [-half, -half, -6, half, half, -5];
    return factsOf([node], [100], [4], () => ({
      box,
      toCube: verticesOf(node).toCube,
      bound,
      frame: frameAt(at),
    })).placingPixels!;
  };
  /** Float32 in eye space: 5 u per term. */
  const rounding = (half: number) => 5 * 2 ** -24 * (Math.sqrt(3 * (2 * half ** 2 + 36)) + 20);

  it("is bound and rounding at the nearest place of the box, not of a sphere around it", () => {
    expect(pixels(30, 0.001)).toBeCloseTo(((0.001 + rounding(30)) * 50) / 5, 9);
    // Ahead of the camera, not below it: the nearest corner lies at (10, 0, -5).
    expect(pixels(10, 0.001)).toBeCloseTo(((0.001 + rounding(10)) * 50) / Math.hypot(10, 5), 9);
  });

  it("grows with the width of a node seen from near, and shows", () => {
    expect(pixels(100_000, 0.01)).toBeGreaterThan(0.05);
    expect(pixels(500, 1e-4)).toBeLessThan(0.05);
  });

  it("covers what float32 does on the way to the eye", () => {
    // A turn, and points of a wide node near the camera, composed as on a GPU.
    const half = 150_000;
    const [sin, cos] = [Math.fround(Math.sin(0.7)), Math.fround(Math.cos(0.7))];
    let worst = 0;
    for (let i = 0; i < 2000; i++) {
      const p = [half * Math.sin(1e3 * i), half * Math.cos(7e3 * i)].map(Math.fround);
      const t = [-p[0]! * Math.cos(0.7) + 3, -p[0]! * Math.sin(0.7) - 2];
      const exact = [0, 1].map((row) =>
        row ? [Math.sin(0.7), Math.cos(0.7)] : [Math.cos(0.7), -Math.sin(0.7)],
      );
      const rows = [
        [cos, Math.fround(-sin)],
        [sin, cos],
      ];
      const off = rows.map(([a, b], row) => {
        const sum = Math.fround(Math.fround(a! * p[0]!) + Math.fround(b! * p[1]!));
        const there = exact[row]![0]! * p[0]! + exact[row]![1]! * p[1]! + t[row]!;
        return Math.fround(sum + Math.fround(t[row]!)) - there;
      });
      worst = Math.max(worst, Math.hypot(...off));
    }
    const stated = 5 * 2 ** -24 * (Math.sqrt(3) * Math.SQRT2 * half + half);
    expect(worst).toBeGreaterThan(0.005);
    expect(worst).toBeLessThanOrEqual(stated);
  });
});

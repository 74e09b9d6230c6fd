import { eastNorthUp, geodeticToEcef } from "@groma/georef";
import { expect, it, vi } from "vitest";
import { defaultStyle, planEffects } from "../effects/index.js";
import { richFacts } from "../effects/scene.fixture.js";
import { OctreeNode } from "../octree/index.js";
import { DrawList } from "./draw-list.js";
import type { DrawnVertices } from "./drawn-vertices.js";
import { FrameAllowance } from "./frame-allowance.js";
import type { ContentRequest } from "./layer-content.js";
import { attributeSet } from "./vertex-attributes.js";
import { TestRenderer } from "./view.fixture.js";

/** Nodes that are drawn, and points of each. */
const NODES = 1000;
const POINTS = 100;

const origin = new Float64Array(3);
geodeticToEcef(0.1, 0.8, 0, origin);

function verticesOf(): DrawnVertices {
  return {
    ...{ positions: new Float32Array(3 * POINTS), columns: new Map(), count: POINTS },
    ...{ frame: eastNorthUp(origin), box: [0, 0, 0, 1, 1, 1], toCube: new Float32Array(12), bound: 0 },
  } as unknown as DrawnVertices;
}

/** Calls of the methods of some objects by their names, until they are asked for again. */
function counter(objects: readonly object[]) {
  const calls: Record<string, number> = {};
  for (const object of objects as readonly Record<string, unknown>[]) {
    for (const name of Object.getOwnPropertyNames(Object.getPrototypeOf(object))) {
      const own = object[name];
      if (typeof own !== "function" || name === "constructor") continue;
      object[name] = (...given: unknown[]) => {
        calls[name] = (calls[name] ?? 0) + 1;
        return own.apply(object, given);
      };
    }
  }
  return () => {
    const counted = { ...calls };
    for (const name of Object.keys(calls)) delete calls[name];
    return counted;
  };
}

/** Frames of 1,000 nodes that are on the GPU. */
function frames() {
  const { gpu, content } = new TestRenderer();
  const nodes = Array.from({ length: NODES }, (_, x) => new OctreeNode({ depth: 10, x, y: 0, z: 0 }));
  const plan = planEffects(defaultStyle({ attributes: [] }), richFacts());
  const vertices = nodes.map(verticesOf);
  const volumes = { state: "in", count: 0, texels: [] } as const;
  const request = (counts: number[], nearest?: number[]): ContentRequest => ({
    ...{ selection: { nodes, counts }, vertices, changes: 0, nearest, plan },
    clips: { form: () => 0, of: () => volumes, advance: () => undefined },
    ...{ depth: { own: false, scene: false }, allowance: new FrameAllowance(() => 0, 1) },
  });
  for (let left = 20; left > 0; left--) content.prepare(request(nodes.map(() => POINTS)));
  return { gpu, content, nodes, request };
}

it("draws a moving frame of 1,000 nodes by few calls, and makes nothing on the GPU", () => {
  const { gpu, content, nodes, request } = frames();
  const place = vi.fn();
  for (const group of content.groups) group.place(1, [0], place);
  expect([content.points, place.mock.calls.length]).toEqual([NODES * POINTS, NODES]);

  const counts = gpu.counts;
  const counted = counter([
    gpu,
    ...content.groups.map(({ uniforms }) => uniforms),
    content.material!.uniforms,
  ]);
  const frame = (points: number) => {
    expect(content.prepare(request(nodes.map((_, index) => points + (index % 7))))).toBe(0);
    for (const group of content.groups) group.place(1, [points], place);
    return counted();
  };
  // A camera that moves shows other numbers of points.
  expect(frame(50)).toMatchInlineSnapshot(`
    {
      "set": 1,
      "setTexture": 1,
      "writeTexture": 1,
    }
  `);
  expect(frame(60)).toEqual({ set: 1, setTexture: 1, writeTexture: 1 });
  expect(gpu.counts).toEqual(counts);
  // One that turns on the spot shows the same: where all of it lies is written anew, and nothing twice.
  for (const by of [70, 70]) for (const group of content.groups) group.place(1, [by], place);
  expect(counted()).toEqual({ setTexture: 1, writeTexture: 1 });
});

it("draws nodes of a page from near to far, each by its row, while points keep their numbers", () => {
  const { content, nodes, request } = frames();
  const counts = nodes.map(() => POINTS);
  // Every tenth is as far as the one before it, so that some are alike.
  const nearest = nodes.map((_, index) => 1 + ((index * 389) % NODES) * (index % 10 === 9 ? 0 : 1));
  content.prepare(request(counts, nearest));
  const [group] = content.groups;
  const drawn = group!.nodes;
  const distances = drawn.map(({ node }) => nearest[nodes.indexOf(node)]!);
  expect(new Set(drawn.map(({ node }) => node)).size).toBe(NODES);
  expect(drawn.map(({ row }) => row)).toEqual(drawn.map((_, index) => index));
  let pages = 0;
  for (const [at, { uploaded }] of drawn.entries()) {
    if (uploaded.page !== drawn[at - 1]?.uploaded.page) pages++;
    // Distances within a thousandth of their range, as a logarithm, count as the same.
    else expect(distances[at - 1]).toBeLessThanOrEqual(1.02 * distances[at]!);
  }
  expect(pages).toBe(new Set(drawn.map(({ uploaded }) => uploaded.page)).size);
  expect(pages).toBeGreaterThan(1);
  const numbered = content.nodes.map(({ node, firstId }) => [node, firstId]);
  expect(numbered).toEqual(nodes.map((node, index) => [node, POINTS * index]));
  const list = new DrawList<object>();
  list.fill(drawn, attributeSet([]));
  expect(list.runs).toBe(pages);
});

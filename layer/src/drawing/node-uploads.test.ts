import { eastNorthUp, geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { OctreeNode } from "../octree/index.js";
import type { NodeVertices } from "../workers/index.js";
import { FrameAllowance } from "./frame-allowance.js";
import type { Gpu, GpuTypes } from "./gpu.js";
import { isReady, NodeUploads } from "./node-uploads.js";
import { PagedNode } from "./paged-node.js";
import { type AttributeSet, attributeSet } from "./vertex-attributes.js";
import { VertexPages } from "./vertex-pages.js";

const origin = new Float64Array(3);
geodeticToEcef(0.1, 0.8, 0, origin);

const read = (column: string, location: number, normalized = false) => ({
  ...{ name: `a_${column}`, type: "vec3" as const, components: 3 as const, column, location, normalized },
});
const PLAIN = attributeSet([read("position", 0)]);
const COLOURED = attributeSet([read("position", 0), read("rgb", 1, true)]);

class Uploaded extends PagedNode<GpuTypes> {
  lift(): void {}
}

/** GPU objects that are counted and nothing else. */
function counted() {
  const alive = new Set<object>();
  const make = <T extends object>(object: T) => {
    alive.add(object);
    return object;
  };
  const gpu = {
    vertexBuffer: (sizeInBytes: number) => make({ kind: "buffer", sizeInBytes }),
    writeBuffer: () => undefined,
    vertexArray: () => make({ kind: "array" }),
    free: (object: object) => void alive.delete(object),
  } as unknown as Gpu<GpuTypes>;
  const count = (kind: string) =>
    [...alive].filter((object) => (object as { kind: string }).kind === kind).length;
  const pages = new VertexPages(gpu);
  const uploads = new NodeUploads((vertices, slot) => new Uploaded(pages, vertices, slot));
  /** Uploads what a frame with time for so many steps allows. */
  const upload = (
    { nodes, vertices }: ReturnType<typeof nodesOf>,
    set: AttributeSet,
    steps: number,
    changes = 0,
  ) =>
    uploads.upload(
      { nodes, vertices: nodes.map(() => vertices), uploaded: uploads.of(nodes) },
      [set],
      frame(steps),
      changes,
    );
  /** Those of the nodes that can be drawn. */
  const ready = (nodes: readonly OctreeNode[], set: AttributeSet) =>
    uploads.of(nodes).map((uploaded) => (uploaded && isReady(uploaded, [set]) ? uploaded : undefined));
  return { uploads, upload, ready, count };
}

/** Nodes of so many points that are here. */
function nodesOf(count: number, points: number) {
  const nodes = Array.from({ length: count }, (_, x) => new OctreeNode({ depth: 4, x, y: 0, z: 0 }));
  const vertices = {
    positions: new Float32Array(3 * points),
    columns: new Map([["rgb", { data: new Uint8Array(3 * points) }]]),
    count: points,
    frame: eastNorthUp(origin),
    box: [0, 0, 0, 1, 1, 1],
  } as unknown as NodeVertices;
  return { nodes, vertices };
}

/** A frame with time for so many steps; for one at least. */
function frame(steps: number): FrameAllowance {
  let now = -1;
  return new FrameAllowance(() => now++, steps);
}

describe("NodeUploads", () => {
  it("uploads as many nodes as a frame allows, in their order, and says how many wait", () => {
    const { upload, ready, count } = counted();
    const seven = nodesOf(7, 10);
    const waiting = [0, 3, 100].map((steps) => upload(seven, PLAIN, steps));
    expect(waiting).toEqual([6, 3, 0]);
    expect(ready(seven.nodes, PLAIN)).not.toContain(undefined);
    // All lie in one page.
    expect([count("buffer"), count("array")]).toEqual([1, 1]);
  });

  it("uploads no more bytes in a frame than 4 MiB and what the last node is over", () => {
    const { upload } = counted();
    const five = nodesOf(5, 150_000);
    // 1.8 MB each.
    expect(upload(five, PLAIN, 100)).toBe(2);
    expect(upload(five, PLAIN, 100)).toBe(0);
  });

  it("draws a node in its former colours until it is whole in others, and frees those then", () => {
    const { upload, ready, count } = counted();
    const one = nodesOf(1, 10);
    const other = nodesOf(1, 10);
    upload(one, COLOURED, 100);
    upload(other, COLOURED, 100);
    const [former] = ready(one.nodes, COLOURED);
    (one.vertices.columns as Map<string, unknown>).set("rgb", { data: new Uint8Array(30) });
    expect(ready(one.nodes, COLOURED)).toEqual([former]);
    // Nobody looks for other colours before points are said to have changed, then also once others were looked at.
    upload(one, COLOURED, 100);
    expect(ready(one.nodes, COLOURED)).toEqual([former]);
    upload(other, COLOURED, 100, 1);
    expect(upload(one, COLOURED, 100, 1)).toBe(0);
    const [later] = ready(one.nodes, COLOURED);
    expect([later === undefined, later === former]).toEqual([false, false]);
    expect([count("buffer"), count("array")]).toEqual([2, 1]);
  });

  it("draws a node in a former style while it waits for what a new one reads, and frees that at last", () => {
    const { uploads, upload, ready, count } = counted();
    const three = nodesOf(3, 10);
    const { nodes } = three;
    upload(three, COLOURED, 100);
    expect(upload(three, PLAIN, 0)).toBe(2);
    expect(ready(nodes, COLOURED)).not.toContain(undefined);
    expect(ready(nodes, PLAIN).map((uploaded) => uploaded !== undefined)).toEqual([true, false, false]);
    upload(three, PLAIN, 100);
    expect(count("buffer")).toBe(2);
    uploads.keep([PLAIN]);
    expect([count("buffer"), count("array")]).toEqual([1, 1]);
    expect(ready(nodes, PLAIN)).not.toContain(undefined);
    expect(ready(nodes.slice(0, 1), COLOURED)).toEqual([undefined]);
  });
});

import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { FRINGE, gather } from "./demand.js";
import {
  everything,
  families,
  family,
  importances,
  kinds,
  known,
  mixed,
  PIXELS_PER_METRE,
  sparsenessOf,
  view,
  views,
} from "./family.fixture.js";
import { type NodeBounds, OctreeNode } from "./octree-node.js";
import { countsAt, pointsAt, shareOf, thresholdFor } from "./share.js";
import { selectNodes } from "./traversal.js";
import type { View } from "./view.js";

describe("gather", () => {
  it("takes from the top down what is in sight and not too small, and tells apart what is to be read", () => {
    /** A node that the screen-space error is to be close to, and how close. */
    const near = fc.record({ child: fc.nat(16), by: fc.double({ min: 1.4, max: 2.4, noNaN: true }) });
    let all = { nodes: 0, pages: 0, open: 0, fringe: 0, out: 0 };
    fc.assert(
      fc.property(families, kinds, views, near, fc.boolean(), (spheres, of, from, { child, by }, prefix) => {
        // Half of the space is out of the picture, and what is high is rejected.
        const planes = [...Array.from(from.direction), 20];
        const rejects = ({ z }: NodeBounds) => z > 300;
        // The root is in sight, seldom a page that is not read.
        const root = mixed([{ x: 0, y: 0, z: 0, radius: 600, spacing: 50 }, ...spheres.slice(1)], of);
        const expected = { nodes: [], pages: [], open: [], fringe: [] } as Record<string, string[]>;
        const onScreen = ({ x, y, z, radius, spacing }: NodeBounds): number => {
          const [px, py, pz] = Array.from(from.position);
          const distance = Math.max(0, Math.hypot(x - px, y - py, z - pz) - radius);
          return (PIXELS_PER_METRE * spacing) / (from.projection.kind === "orthographic" ? 1 : distance);
        };
        const error = Math.min(1e6, by * onScreen(spheres[child]));
        const spacings = new Map<string, number>();
        const caps = new Map<string, number>();
        const visit = (node: OctreeNode, base: boolean): void => {
          const { x, y, z, radius } = node.bounds!;
          const pixels = onScreen(node.bounds!);
          const inner = x * planes[0] + y * planes[1] + z * planes[2] + 20;
          if (inner < -radius || rejects(node.bounds!)) {
            all.out++;
            return;
          }
          // A node with its parents shows points half as far apart as the parents do alone.
          if (!base && 2 * pixels <= error) {
            if (2 * pixels > FRINGE * error) expected.fringe.push(node.name);
            return;
          }
          if (node.state === "page" || node.state === "opening" || node.pageFailed) {
            expected.pages.push(node.name);
            return;
          }
          if (node.page?.root === node) expected.open.push(node.name);
          if (node.pointCount > 0) {
            expected.nodes.push(node.name);
            spacings.set(node.name, pixels);
            const apart = base ? pixels * sparsenessOf(node) : pixels;
            caps.set(node.name, prefix ? shareOf(apart, error, base) : 1);
          }
          const bare = base && node.pointCount === 0;
          // The children of a node are half as far apart: those of one that is whole at nine tenths may be in the fringe.
          if (!bare && pixels <= FRINGE * error) return;
          for (const child of node.children ?? []) if (child) visit(child, bare);
        };
        visit(root, true);
        const options = { ...everything, maximumScreenSpaceError: error, prefix, rejects };
        const found = gather(root, { ...from, planes }, options, known);
        const names = (nodes: readonly OctreeNode[]) => nodes.map(({ name }) => name).sort();
        const { nodes, pages, open, fringe, demand } = found;
        expect({
          nodes: names(nodes),
          pages: names(pages),
          open: names(open.map((page) => page.root)),
          fringe: names(fringe),
        }).toEqual({
          nodes: expected.nodes.sort(),
          pages: expected.pages.sort(),
          open: expected.open.sort(),
          fringe: expected.fringe.sort(),
        });
        nodes.forEach((node, index) => {
          expect(1 / found.spacings[index]).toBeCloseTo(1 / spacings.get(node.name)!, 9);
          expect(demand.caps[index]).toBeCloseTo(caps.get(node.name)!, 6);
          expect(demand.sizes[index]).toBe(node.pointCount);
        });
        all = {
          nodes: all.nodes + nodes.length,
          pages: all.pages + pages.length,
          open: all.open + open.length,
          fringe: all.fringe + fringe.length,
          out: all.out,
        };
      }),
      { numRuns: 400 },
    );
    for (const [what, count] of Object.entries(all)) expect(count, what).toBeGreaterThan(5);
  });

  it("leaves out for a limit what is below the spacing that the limit allows, and nothing that has none above", () => {
    const limits = fc.integer({ min: 1, max: 8000 });
    let left = 0;
    fc.assert(
      fc.property(families, kinds, limits, fc.boolean(), (spheres, of, limit, prefix) => {
        const whole = gather(mixed(spheres, of), view, { ...everything, prefix }, known);
        const part = gather(mixed(spheres, of), view, { ...everything, prefix, limit }, known);
        const threshold = thresholdFor([whole.demand], limit);
        const there = new Set(part.nodes.map(({ name }) => name));
        whole.nodes.forEach(({ name }, index) => {
          if (there.has(name)) return;
          left++;
          expect(whole.demand.base[index]).toBe(false);
          expect(2 * whole.demand.pixels[index]).toBeLessThan(threshold);
        });
        const bases = ({ demand }: typeof part) => demand.base.filter((base) => base).length;
        expect(bases(part)).toBe(bases(whole));
        // Some more than are needed, since what the limit allows is asked at times only.
        const needed = whole.demand.pixels.filter((pixels) => 2 * pixels >= threshold * (1 - 1e-5)).length;
        expect(part.nodes.length).toBeLessThanOrEqual(1.5 * needed + 3 + bases(part));
      }),
      { numRuns: 300 },
    );
    expect(left).toBeGreaterThan(100);
  });

  it("leaves it to a limit which of many nodes just at its spacing are drawn whole", () => {
    const at = (x: number): NodeBounds => ({ x, y: 0, z: 0, radius: 10, spacing: 1 });
    // All children look alike, and so do all of theirs.
    const spheres = [{ ...at(0), spacing: 10 }, ...new Array(8).fill(at(100)), ...new Array(8).fill(at(300))];
    for (let limit = 150; limit < 1700; limit += 100) {
      const options = { ...everything, prefix: false, limit };
      const { demand } = gather(
        family(spheres, () => 100),
        view,
        options,
        known,
      );
      const counts = countsAt(demand, thresholdFor([demand], limit), limit);
      expect(counts.reduce((sum, count) => sum + count, 0)).toBe(limit - 50);
    }
  });

  it("ranks nodes that the camera is in before all others, the widest apart first", () => {
    const spheres: NodeBounds[] = Array.from({ length: 17 }, (_, index) => ({
      ...{ x: index < 9 ? 5 : 40, y: 0, z: 0, radius: 10 },
      spacing: index === 0 ? 20 : index < 9 ? 1 + index : 15,
    }));
    const { nodes, demand } = gather(family(spheres), view, everything, known);
    const inside = nodes.slice(0, 9).map(({ bounds }) => bounds!.spacing);
    expect(inside).toEqual([20, 9, 8, 7, 6, 5, 4, 3, 2]);
    expect(demand.pixels.slice(0, 9)).toEqual(inside.map((spacing) => 1e12 * spacing));
    expect(Math.max(...demand.pixels.slice(9))).toBeLessThan(1e6);
  });

  it("takes a node around the camera of a parallel view for one in the middle of the picture", () => {
    const flat: View = { ...view, projection: { kind: "orthographic", extent: 1000 / PIXELS_PER_METRE } };
    for (const x of [-9, 0, 9]) {
      const sphere: NodeBounds = { x, y: 0, z: 0, radius: 10, spacing: 2 };
      const { demand } = gather(family(new Array(17).fill(sphere)), flat, everything, known);
      expect(new Set(demand.pixels)).toEqual(new Set([2 * PIXELS_PER_METRE]));
    }
  });

  it("leaves out no point of a sparse root that the screen-space error tells from the next", () => {
    const drawn = (points: number, metresPerPixel: number) => {
      const root = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "listed");
      root.pointCount = points;
      // 256 m wide and long, in 128 cells to a side.
      root.bounds = { x: 0, y: 0, z: 0, radius: 128 * Math.SQRT2, spacing: 2 };
      const flat: View = { ...view, projection: { kind: "orthographic", extent: 1000 * metresPerPixel } };
      const options = { maximumScreenSpaceError: 2, pointBudget: 1e6 };
      return selectNodes(root, flat, options, known).points;
    };
    // 100 points, 25.6 m apart; of 16,384 there is one in each cell.
    expect([1, 5, 12.7].map((metres) => drawn(100, metres))).toEqual([100, 100, 100]);
    expect([25.6, 51.2].map((metres) => drawn(100, metres))).toEqual([25, 6]);
    expect([0.9, 2, 4].map((metres) => drawn(128 ** 2, metres))).toEqual([16_384, 4_096, 1_024]);
    // More than one in a cell are as far apart as the cells.
    expect(drawn(50_000, 2)).toBe(12_500);
  });

  it("asks for the sphere of a node once", () => {
    const sphere: NodeBounds = { x: 100, y: 0, z: 0, radius: 10, spacing: 1 };
    const root = family(new Array(17).fill(sphere));
    let asked = 0;
    const visit = (node: OctreeNode) => {
      node.bounds = undefined;
      for (const child of node.children ?? []) if (child) visit(child);
    };
    visit(root);
    for (let frame = 0; frame < 2; frame++) {
      gather(root, view, everything, () => {
        asked++;
        return sphere;
      });
    }
    expect(asked).toBe(17);
  });

  it("ranks nodes by their spacing on the screen and their place in it, none above its parent", () => {
    fc.assert(
      fc.property(families, views, (spheres, view) => {
        const root = family(spheres);
        const expected = importances(root, view);
        const { nodes, demand } = gather(root, view, everything, known);
        expect(nodes).toHaveLength(17);
        nodes.forEach((node, index) => {
          const wanted = expected.get(node.name)!;
          // As distances, which are good to 1e-12 m: close to the edge of a sphere they become few.
          const off = Math.abs(1 / demand.pixels[index] - 1 / wanted);
          expect(off).toBeLessThanOrEqual(1e-9 / wanted + 1e-11);
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

  it("gathers all that a limit lets through, and tells as good a threshold as if it had gathered everything", () => {
    fc.assert(
      fc.property(families, fc.integer({ min: 1, max: 15_000 }), (spheres, limit) => {
        const whole = gather(family(spheres), view, everything, known);
        const part = gather(family(spheres), view, { ...everything, limit }, known);
        const threshold = thresholdFor([part.demand], limit);
        const points = pointsAt(whole.demand, threshold);
        expect(points).toBeLessThanOrEqual(limit * (1 + 1e-6));
        // To half a point, below which one threshold is as good as another.
        if (threshold > 0) expect(points).toBeGreaterThanOrEqual(limit - 0.5 - 1e-6 * limit);
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

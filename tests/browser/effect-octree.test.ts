import { describe, expect, it } from "vitest";
import { encodeVisibleOctree, inSteps } from "../../layer/src/effects/index.js";
import type { VoxelKey } from "../../layer/src/octree/index.js";
import { draw, random, SIZE, usePage } from "./effect-draw.js";

const page = usePage();

describe("the visible octree on the GPU", () => {
  /** Some drawn nodes: each child is drawn by chance, deeper where x is small. */
  function someTree(seed: number): VoxelKey[] {
    const next = random(seed);
    const keys: VoxelKey[] = [{ depth: 0, x: 0, y: 0, z: 0 }];
    for (let at = 0; at < keys.length; at++) {
      const { depth, x, y, z } = keys[at];
      for (let octant = 0; octant < 8; octant++) {
        const key = {
          depth: depth + 1,
          x: 2 * x + (octant & 1),
          y: 2 * y + ((octant >> 1) & 1),
          z: 2 * z + (octant >> 2),
        };
        const likely = depth < 2 ? 0.9 : depth < 9 ? 0.28 : 0;
        if (next() < likely) keys.push(key);
      }
    }
    return keys;
  }

  it("gives each point the level of the deepest drawn node around it, from its own node down", async () => {
    const keys = someTree(4);
    expect(keys.length).toBeGreaterThan(300);
    const names = new Set(keys.map(({ depth, x, y, z }) => `${depth} ${x} ${y} ${z}`));
    const nodes = keys.map((key) => ({
      key,
      points: 100,
      count: 100,
      leaf: false,
      spacing: 2 ** -key.depth,
      box: [0, 0, 0, 1, 1, 1],
    }));
    const { texture, width, height, indices } = encodeVisibleOctree(nodes);
    const next = random(8);
    // The root, and some nodes farther down.
    for (const own of [0, 3, 40, 120]) {
      const key = keys[own];
      const places = Array.from({ length: 500 }, () => [next(), next(), next()]);
      const expected = places.map((place) => {
        let depth = key.depth;
        for (let below = 1; ; below++) {
          const cell = [key.x, key.y, key.z].map((index, axis) =>
            Math.floor((index + place[axis]) * 2 ** below),
          );
          if (!names.has(`${key.depth + below} ${cell.join(" ")}`)) return depth;
          depth++;
        }
      });
      const { values } = await draw(
        page(),
        {
          style: { color: "levelOfDetail", gradient: "greyscale", range: [0, 255], size: "adaptive" },
          facts: { levels: [0, 9] },
          // The node frame is turned and larger than the cube: x there is y here.
          node: {
            octreeIndex: indices[own],
            level: key.depth,
            spacing: 2 ** -key.depth,
            toCube: [0, 0.1, 0, 0, 0.1, 0, 0, 0, 0, 0, -0.1, -0.5],
          },
          columns: { position: places.flatMap(([x, y, z]) => [10 * y, 10 * x, -10 * z - 5]) },
          textures: [{ name: "u_octree", width, height, data: [...texture], float: false }],
        },
        ["v_color", "gl_PointSize"],
      );
      const levels = places.map((_, point) => Math.round(values[4 * point] * 255));
      expect(levels).toEqual(expected);
      // Width: two spacings of that level, seen from the point's depth in a view of 90°.
      places.forEach(([, , z], point) => {
        const width = (2 * 2 ** -expected[point] * (SIZE / 2)) / (10 * z + 5);
        expect(values[4 * point + 3]).toBeCloseTo(Math.max(1, width), 4);
      });
    }
  });
});

describe("positions at whole steps on the GPU", () => {
  it("are seen where the same in metres are, bit for bit", async () => {
    const next = random(12);
    const step = 2 ** -9;
    const turn = [0.6, 0.64, -0.48, 0, 0, 0.6, 0.8, 0, 0.8, -0.48, 0.36, 0];
    const ends = [-(2 ** 20) + 1, 2 ** 20 - 1, -65_536, 65_536, -65_537, 65_535, -1, 0, 1];
    const whole = Array.from({ length: 3 * 1000 }, (_, at) =>
      at < 27 ? ends[(at * 5) % 9] : Math.round((2 * next() - 1) * (2 ** 20 - 1)),
    );
    const metres = whole.map((steps) => steps * step);
    const rgb = new Array(4 * 1000).fill(1);
    const modelView = (per: number) => [...turn.map((value) => value * per), 100.25, -7, -1500, 1];
    const of = (position: readonly number[], per: number, node?: { step: number }) =>
      draw(
        page(),
        { columns: { position, rgb }, view: { u_modelView: modelView(per) }, ...(node && { node }) },
        ["gl_Position"],
      );
    const exact = await of(metres, 1);
    const stored = await of([...inSteps(Float32Array.from(metres), step)], step, { step });
    expect(new Set(exact.values).size).toBeGreaterThan(2000);
    expect(stored.values).toEqual(exact.values);
  });
});

import { describe, expect, it } from "vitest";
import { FRONT } from "../../layer/src/effects/index.js";
import { draw, SIZE, usePage } from "./effect-draw.js";

const page = usePage();

describe("shapes", () => {
  const single = { position: [0.3, -0.2, -20], rgb: [255, 0, 0, 255] };

  it("a paraboloid recedes from the point's own depth by the square of the distance from its middle", async () => {
    const { values, depths, plan } = await draw(
      page(),
      { style: { shape: "paraboloid", pointSize: 21 }, columns: single },
      undefined,
    );
    expect(plan.active.has("paraboloid")).toBe(true);
    const [x, y] = [0.3, -0.2].map((at) => (at / 20 + 1) * (SIZE / 2));
    const radius = (21 / 2) * (20 / (SIZE / 2));
    let seen = 0;
    for (let row = 0; row < SIZE; row++) {
      for (let column = 0; column < SIZE; column++) {
        const squared = ((column + 0.5 - x) ** 2 + (row + 0.5 - y) ** 2) / 10.5 ** 2;
        const at = row * SIZE + column;
        if (Math.abs(squared - 1) < 0.02) continue;
        expect(values[4 * at] > 0).toBe(squared < 1);
        if (squared >= 1) continue;
        const z = 20 + radius * squared;
        expect(depths[at]).toBeCloseTo((1001 / 999 - 2000 / 999 / z) / 2 + 0.5, 4);
        seen++;
      }
    }
    expect(seen).toBeGreaterThan(300);
  });

  it("the weights of a splat are (1 − d²) to the hardness, its colours times that", async () => {
    const { values } = await draw(
      page(),
      { style: { splats: true, pointSize: 21, hardness: 3 }, columns: single, pass: "splat" },
      undefined,
    );
    const [x, y] = [0.3, -0.2].map((at) => (at / 20 + 1) * (SIZE / 2));
    for (const [column, row] of [
      [32, 31],
      [36, 34],
      [29, 40],
      [40, 31],
    ]) {
      const squared = ((column + 0.5 - x) ** 2 + (row + 0.5 - y) ** 2) / 10.5 ** 2;
      const weight = Math.max(0, 1 - squared) ** 3;
      const at = 4 * (row * SIZE + column);
      expect(values[at + 3]).toBeCloseTo(weight, 2);
      expect(values[at]).toBeCloseTo(weight, 2);
    }
  });

  it("splats are drawn nearer by their radius, on the ray through them, and the depth pass is not", async () => {
    const style = { splats: true, pointSize: 16 };
    const columns = { position: [3, -4, -20], rgb: [255, 0, 0, 255] };
    const splat = await draw(page(), { style, columns, pass: "splat" }, ["gl_Position"]);
    const depth = await draw(page(), { style, columns, pass: "depth" }, ["gl_Position"]);
    // 8 px of 32 px per tan 45° at 20 m: 5 m.
    expect(depth.values[3]).toBeCloseTo(20, 4);
    expect(splat.values[3]).toBeCloseTo(15, 4);
    for (const axis of [0, 1]) {
      expect(splat.values[axis] / splat.values[3]).toBeCloseTo(depth.values[axis] / depth.values[3], 5);
    }
  });

  it("narrow splats are left out where all four pixels around show something nearer", async () => {
    const columns = { position: [0, 0, -20], rgb: [255, 0, 0, 255] };
    const place = async (pointSize: number, depths: readonly number[]) => {
      const data = Array.from({ length: SIZE * SIZE }, () => [1, 0, 0, 1]);
      // The point stands where four pixels meet, which have these depths.
      for (const [at, depth] of depths.entries()) {
        data[(SIZE / 2 - 1 + (at >> 1)) * SIZE + SIZE / 2 - 1 + (at & 1)] = [depth, 0, 0, 1];
      }
      const front = { name: FRONT, width: SIZE, height: SIZE, data: data.flat(), float: true };
      const textures = pointSize > 2 ? [] : [front];
      const drawn = { style: { splats: true, pointSize }, columns, textures, pass: "splat" } as const;
      const { values } = await draw(page(), drawn, ["gl_Position"]);
      return { depth: 0.5 + values[2]! / values[3]! / 2, shown: values[0] === 0 };
    };
    for (const size of [1, 2]) {
      const { depth, shown } = await place(size, []);
      expect(shown).toBe(true);
      const [nearer, farther] = [depth - 1e-5, depth + 1e-5];
      expect((await place(size, [nearer, nearer, nearer, nearer])).shown).toBe(false);
      expect((await place(size, [depth, depth, depth, depth])).shown).toBe(true);
      for (let one = 0; one < 4; one++) {
        const depths = [nearer, nearer, nearer, nearer].with(one, farther);
        expect((await place(size, depths)).shown).toBe(true);
      }
    }
    // A wider one covers more pixels than these.
    expect((await place(2.5, [0, 0, 0, 0])).shown).toBe(true);
  });

  it("the numbers of points are read back exactly", async () => {
    const firstId = 0x1234567;
    const { values } = await draw(
      page(),
      {
        style: { pointSize: 3 },
        node: { firstId },
        columns: { position: [0, 0, -20, 10, 0, -20] },
        pass: "id",
      },
      undefined,
    );
    const id = (column: number, row: number) =>
      [0, 1, 2, 3].reduce(
        (sum, byte) => sum + Math.round(values[4 * (row * SIZE + column) + byte] * 255) * 256 ** byte,
        0,
      );
    expect([id(32, 32), id(48, 32), id(5, 5)]).toEqual([firstId + 1, firstId + 2, 0]);
  });
});

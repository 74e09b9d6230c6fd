import { expect, it, vi } from "vitest";
import { defaultStyle, type EffectPlan, planEffects } from "../effects/index.js";
import { richFacts } from "../effects/scene.fixture.js";
import { OctreeNode } from "../octree/index.js";
import type { DrawnNode } from "./drawn-node.js";
import type { Gpu } from "./gpu.js";
import { NodeGroup } from "./node-group.js";
import { TestGpu, type TestView } from "./view.fixture.js";

const attributes = [{ name: "intensity", kind: "scalar", range: [0, 100] }] as const;
const facts = richFacts({ attributes });
const style = { ...defaultStyle({ attributes }), color: "intensity", gamma: 1 };
const planOf = (range: readonly [number, number]) => planEffects({ ...style, range }, facts);

/** A graphics library that keeps the last table it was given. */
function recorder() {
  const gpu = new TestGpu();
  let table = new Float32Array();
  const keep = ({ data }: { readonly data: ArrayBufferView }) => {
    table = Float32Array.from(data as Float32Array);
  };
  const dataTexture = vi.spyOn(gpu, "dataTexture").mockImplementation((texels) => {
    keep(texels);
    return { width: texels.width, height: texels.height, destroy: () => undefined };
  });
  vi.spyOn(gpu, "writeTexture").mockImplementation(((_: unknown, texels: { data: ArrayBufferView }) =>
    keep(texels)) as typeof gpu.writeTexture);
  return { gpu: gpu as unknown as Gpu<TestView>, dataTexture, table: () => table };
}

/** A node whose intensities are read one time in a style, however often it is drawn. */
function nodeOf(x: number) {
  const get = vi.fn(() => ({ scale: 1, offset: 0 }));
  const uploaded = {
    vertices: { columns: { get }, toCube: Array(12).fill(0) },
    first: 10,
    slot: x,
  };
  const node = new OctreeNode({ depth: 1, x, y: 0, z: 0 });
  const drawn = (row: number, firstId: number) =>
    ({ node, uploaded, row, firstId, octreeIndex: 0, clipRecords: [0, 0] }) as unknown as DrawnNode<TestView>;
  return { get, drawn };
}

it("forms what effects say of a node once for a style, and writes what a frame says of it in each", () => {
  const { gpu, table } = recorder();
  const plan = planOf([0, 100]);
  const group = new NodeGroup<TestView>(gpu, plan, gpu.uniforms(undefined as never));
  const at = (name: string) => group.placeIn(name)!;
  const [a, b] = [nodeOf(0), nodeOf(1)];
  /** Numbers of first points, and factors that values are shown by, of the rows. */
  const rows = (by: EffectPlan, nodes: readonly DrawnNode<TestView>[]) => {
    group.take(by, nodes);
    const begins: number[] = [];
    group.place(1, [], (_node, _copy, _table, begin) => void begins.push(begin));
    return begins.map((begin) => [table()[begin + at("u_firstId") + 1], table()[begin + at("u_value0")]]);
  };
  expect(rows(plan, [a.drawn(0, 10), b.drawn(1, 30)])).toEqual([
    [0, Math.fround(0.01)],
    [20, Math.fround(0.01)],
  ]);
  // In the other order, and with other numbers of points.
  expect(rows(plan, [b.drawn(0, 15), a.drawn(1, 22)])).toEqual([
    [5, Math.fround(0.01)],
    [12, Math.fround(0.01)],
  ]);
  expect([a.get, b.get].map((get) => get.mock.calls.length)).toEqual([1, 1]);
  const other = planOf([0, 50]);
  expect(other.key).toBe(plan.key);
  expect(rows(other, [a.drawn(0, 10)])).toEqual([[0, Math.fround(0.02)]]);
  const filtered = planEffects(style, richFacts({ attributes: [{ ...attributes[0], range: [0, 10] }] }));
  expect(filtered.key).toBe(plan.key);
  expect(rows(filtered, [a.drawn(0, 10)])).toEqual([[0, Math.fround(0.1)]]);
});

it("writes nothing where neither the nodes nor what they are placed by is another", () => {
  const { gpu, dataTexture } = recorder();
  const plan = planOf([0, 100]);
  const group = new NodeGroup<TestView>(gpu, plan, gpu.uniforms(undefined as never));
  group.take(plan, [nodeOf(0).drawn(0, 0)]);
  const place = vi.fn();
  for (const by of [[1], [1], [2]]) group.place(2, by, place);
  expect(place).toHaveBeenCalledTimes(4);
  group.replace();
  group.place(2, [2], place);
  expect(place).toHaveBeenCalledTimes(6);
  expect(dataTexture).toHaveBeenCalledTimes(1);
});

import fc from "fast-check";
import { expect, it } from "vitest";
import { inSteps, nodeLayoutOf, planEffects, WEBGL2 } from "../effects/index.js";
import { richFacts, styleOf } from "../effects/scene.fixture.js";
import { OctreeNode, type Selection, type ShapedPoints } from "../octree/index.js";
import { nodesHere } from "../octree/nodes-here.fixture.js";
import { reachOf, stepBound, stepOver, toSteps } from "../workers/position-steps.js";
import { positionBox } from "../workers/records.js";
import type { FrameCamera } from "./frame-camera.js";
import type { Gpu, GpuTypes } from "./gpu.js";
import { NodeTable } from "./node-table.js";
import { sceneFacts } from "./scene-facts.js";

/** Axes as they are, about the origin. */
const FRAME = { origin: new Float64Array(3), rotation: Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1) };
/** A view of 90°, 100 pixels high: 50 pixels per metre a metre away. Where it looks plays no part. */
const view = (position: readonly [number, number, number]): FrameCamera => ({
  view: {
    ...{ position: [...position], direction: [1, 0, 0], planes: new Array(24).fill(0), height: 100 },
    ...{ projection: { kind: "perspective", fieldOfView: Math.PI / 2 }, horizon: false },
  },
  ...{ width: 100, pixelRatio: 1, near: 0.1, depth: { own: true, scene: true }, pose: () => [] },
});

/** What a node's points are stated to be off on screen. */
function placingPixels(vertices: ShapedPoints, eye: readonly [number, number, number]): number {
  const node = new OctreeNode({ depth: 0, x: 0, y: 0, z: 0 }, "listed");
  node.bounds = { x: 0, y: 0, z: 0, radius: 1, spacing: 1 };
  const selection = { nodes: [node], points: 1, counts: [1], spacings: [1] } as unknown as Selection;
  const layer = {
    ...{ attributes: [], clips: 0, highlights: 0 },
    ...{ filter: undefined, silhouettes: undefined, placing: undefined },
  };
  return sceneFacts(view(eye), selection, nodesHere([node], [vertices]), layer).placingPixels!;
}

it("states what whole steps and float32 do on the way to the eye, whatever the node and the camera", () => {
  const number = (min: number, max: number) => fc.double({ min, max, noNaN: true });
  const place = fc.tuple(number(-1, 1), number(-1, 1), number(-1, 1));
  const points = fc.array(place, { minLength: 5, maxLength: 40 });
  const layout = nodeLayoutOf(planEffects(styleOf(), richFacts()), WEBGL2);
  const { at } = layout.fields.find(({ name }) => name === "u_modelView")!;
  const table = new NodeTable({} as Gpu<GpuTypes>, layout);
  let closest = 0;
  fc.assert(
    fc.property(number(-2, 4), number(-1, 7), place, place, points, (wide, far, turn, towards, shares) => {
      const exact = Float32Array.from(shares.flat(), (share) => share * 10 ** wide);
      const step = stepOver(reachOf(exact));
      const stored = exact.slice();
      toSteps(stored, step);
      const box = positionBox(stored);
      const eye = towards.map((share) => share * 10 ** far) as [number, number, number];
      const { x, y, z, w } = quaternion(turn);
      const rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
      ];
      const shift = rows.map((row) => -row.reduce((sum, value, axis) => sum + value * eye[axis]!, 0));
      const columns = [0, 1, 2].flatMap((column) => [...rows.map((row) => row[column]!), 0]);
      const row = new Float32Array(table.width);
      table.writeValues(row, 0, { u_modelView: [...columns, ...shift, 1] }, step);
      const matrix = row.subarray(at, at + 12);

      const bound = stepBound(step);
      const vertices = { box, bound, toCube: new Float32Array(12), frame: FRAME };
      const stated = placingPixels(vertices, eye);
      const buffer = inSteps(stored, step);
      for (let point = 0; point < exact.length / 3; point++) {
        const read = readStored(buffer.subarray(4 * point, 4 * point + 4));
        const drawn = rows.map((_, row) => seen(matrix.subarray(4 * row, 4 * row + 4), read));
        const true_ = rows.map((row, at) =>
          row.reduce((sum, value, axis) => sum + value * exact[3 * point + axis]!, shift[at]!),
        );
        const off = Math.hypot(...true_.map((value, axis) => value - drawn[axis]!));
        const away = Math.hypot(...[0, 1, 2].map((axis) => stored[3 * point + axis]! - eye[axis]!));
        const pixels = (off * 50) / Math.max(0.1, away);
        expect(pixels).toBeLessThanOrEqual(stated);
        closest = Math.max(closest, pixels / stated);
      }
    }),
  );
  // The statement is no wild guess.
  expect(closest).toBeGreaterThan(0.1);
});

/** A turn by three shares of 1, as a quaternion (K. Shoemake). */
function quaternion([a, b, c]: readonly [number, number, number]) {
  const [u, v, t] = [(a + 1) / 2, Math.PI * b, Math.PI * c];
  const [p, q] = [Math.sqrt(1 - u), Math.sqrt(u)];
  return { x: p * Math.sin(v), y: p * Math.cos(v), z: q * Math.sin(t), w: q * Math.cos(t) };
}

/** `STORED` of the shaders, each step rounded to float32. */
function readStored([x, y, z, w]: Uint16Array): number[] {
  const upper = [26, 21, 16].map((shift) => (w! << shift) >> 27);
  return [x!, y!, z!].map((lower, axis) => Math.fround(lower + Math.fround(65_536 * upper[axis]!)));
}

/** A row of a matrix times a place, each step rounded to float32. */
function seen(row: ArrayLike<number>, place: readonly number[]): number {
  const terms = place.map((value, axis) => Math.fround(row[axis]! * value));
  return Math.fround(Math.fround(Math.fround(terms[0]! + terms[1]!) + terms[2]!) + row[3]!);
}

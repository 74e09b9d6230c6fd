import { BoundingSphere, Cartesian3, Matrix4 } from "cesium";
import { expect, it } from "vitest";
import { PointDraws } from "../drawing/point-draws.js";
import { attributeSet } from "../drawing/vertex-attributes.js";
import type { Context, VertexArray } from "./engine/cesium-private.js";
import { type CesiumNode, NodePlaces } from "./node-drawable.js";
import { type DrawState, NodesVolume, PointBatch } from "./point-batch.js";

/** A context that keeps what is done with it. */
function recorder() {
  const calls: unknown[][] = [];
  const program = {};
  const record =
    (name: string) =>
    (...given: unknown[]) =>
      void calls.push([name, ...given]);
  const gl = {
    ...{ POINTS: 0, CURRENT_PROGRAM: 1, getParameter: () => program, getSupportedExtensions: () => [] },
    getUniformLocation: (_: unknown, name: string) => name,
    uniform1i: record("number"),
    drawArrays: record("draw"),
  };
  const arrayOf = (name: string): VertexArray => ({
    _bind: () => void calls.push(["bind", name]),
    _unBind: () => void calls.push(["unbind", name]),
    destroy: () => undefined,
  });
  const context = { _gl: gl } as unknown as Context;
  return { calls, objects: { context, draws: new PointDraws(context._gl) }, arrayOf };
}

const state = {
  program: { program: {}, reads: attributeSet([]) },
  uniformMap: {},
  pass: 0,
} as unknown as DrawState;

it("draws exactly its nodes, each by its row in the table, whenever Cesium binds it", () => {
  const { calls, objects, arrayOf } = recorder();
  const batch = new PointBatch(objects);
  const places = new NodePlaces();
  for (const slot of [0, 1, 2]) {
    places.write(slot, Matrix4.IDENTITY, 1, new BoundingSphere(Cartesian3.UNIT_X, slot + 1));
  }
  const node = (name: string, row: number, count: number) =>
    ({
      row,
      count,
      uploaded: {
        ...{ arrayOf: () => arrayOf(name), first: 100 * row },
        ...{ places, slot: row },
      },
    }) as unknown as CesiumNode;
  const nodes = [node("a", 0, 10), node("c", 2, 7)];
  const command = batch.command(nodes, state);
  expect(command.count).toBe(0);
  expect(Matrix4.equals(command.modelMatrix, Matrix4.IDENTITY)).toBe(true);
  command.vertexArray._bind();
  command.vertexArray._unBind();
  expect(calls).toEqual([
    ["bind", "a"],
    ["number", "u_node", 0],
    ["draw", 0, 0, 10],
    ["bind", "c"],
    ["number", "u_node", 2],
    ["draw", 0, 200, 7],
    ["unbind", "c"],
  ]);
  calls.length = 0;
  const again = batch.command([nodes[1]], state);
  expect(again).toBe(command);
  again.vertexArray._bind();
  expect(calls.filter(([name]) => name === "draw")).toEqual([["draw", 0, 200, 7]]);
});

it("lies as near and as far as its nodes do, not as the sphere around them", () => {
  const volume = new NodesVolume();
  const places = new NodePlaces();
  let slot = 0;
  const at = (x: number, y: number) => {
    places.write(slot, Matrix4.IDENTITY, 1, new BoundingSphere(new Cartesian3(x, y, 0), 1));
    return { uploaded: { places, slot: slot++ } };
  };
  volume.hold([at(100, 0), at(100, 5000)]);
  const { start, stop } = volume.computePlaneDistances(Cartesian3.ZERO, Cartesian3.UNIT_X);
  expect([start, stop]).toEqual([99, 101]);
  expect(volume.center).toEqual(new Cartesian3(100, 2500, 0));
  expect(volume.radius).toBe(2501);
  volume.hold([at(7, 0)]);
  expect(volume.computePlaneDistances(Cartesian3.ZERO, Cartesian3.UNIT_X).start).toBe(6);
});

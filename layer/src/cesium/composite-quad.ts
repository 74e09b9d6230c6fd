import { type BoundingSphere, ComponentDatatype, Matrix4, PrimitiveType } from "cesium";
import {
  type Buffer,
  DrawCommand,
  Pass,
  type UniformMap,
  type VertexArray,
} from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import type { QuadProgram } from "./point-programs.js";
import type { SceneStates } from "./scene-states.js";

/** Corners of a triangle that covers the picture. */
const CORNERS = new Float32Array([-1, -1, 3, -1, -1, 3]);

/** Puts a picture of the points into the scene: a triangle over the whole of it, with colours and depths. */
export class CompositeQuad {
  readonly #objects: GpuObjects;
  readonly #owner: object;
  readonly #states: SceneStates;
  #corners: Buffer | undefined;
  #array: VertexArray | undefined;
  #command: DrawCommand | undefined;

  constructor(objects: GpuObjects, owner: object, states: SceneStates) {
    this.#objects = objects;
    this.#owner = owner;
    this.#states = states;
  }

  /**
   * The command for Cesium's list.
   * @param sphere around all points of the picture, ECEF, metres: Cesium draws the quad in each frustum that it meets
   */
  command(
    { program }: QuadProgram,
    uniformMap: UniformMap,
    sphere: BoundingSphere,
    translucent: boolean,
  ): DrawCommand {
    const renderState = translucent ? this.#states.translucent : this.#states.opaque;
    const pass = translucent ? Pass.TRANSLUCENT : Pass.OPAQUE;
    const changing = { shaderProgram: program, uniformMap, boundingVolume: sphere, renderState, pass };
    if (this.#command) return Object.assign(this.#command, changing);
    this.#command = new DrawCommand({
      ...changing,
      owner: this.#owner,
      vertexArray: this.#vertexArray(),
      primitiveType: PrimitiveType.TRIANGLES,
      count: 3,
      modelMatrix: Matrix4.IDENTITY,
    });
    return this.#command;
  }

  destroy(): void {
    this.#objects.free(this.#array);
    this.#objects.free(this.#corners);
    this.#command = undefined;
  }

  #vertexArray(): VertexArray {
    this.#corners = this.#objects.vertexBuffer(CORNERS);
    this.#array = this.#objects.vertexArray([
      {
        index: 0,
        vertexBuffer: this.#corners,
        componentsPerAttribute: 2,
        componentDatatype: ComponentDatatype.FLOAT,
        normalize: false,
      },
    ]);
    return this.#array;
  }
}

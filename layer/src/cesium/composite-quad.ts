import { type BoundingSphere, Matrix4, PrimitiveType } from "cesium";
import type { Program } from "../drawing/programs.js";
import {
  type Buffer,
  DrawCommand,
  Pass,
  type UniformMap,
  type VertexArray,
} from "./engine/cesium-private.js";
import type { CesiumTypes, GpuObjects } from "./engine/gpu-objects.js";
import type { RenderStates } from "./engine/render-states.js";

/** Corners of a square, as a strip of triangles; the program lays it over the part of the picture that shows points. */
const CORNERS = new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]);

/** Puts a picture of the points into the scene: a rectangle over what shows points of it, with colours and depths. */
export class CompositeQuad {
  readonly #objects: GpuObjects;
  readonly #owner: object;
  readonly #states: RenderStates;
  #corners: Buffer | undefined;
  #array: VertexArray | undefined;
  #command: DrawCommand | undefined;

  constructor(objects: GpuObjects, owner: object, states: RenderStates) {
    this.#objects = objects;
    this.#owner = owner;
    this.#states = states;
  }

  /**
   * The command for Cesium's list.
   * @param sphere around all points of the picture, ECEF, metres: Cesium draws the quad in each frustum that it meets
   */
  command(
    { program }: Program<CesiumTypes>,
    uniformMap: UniformMap,
    sphere: BoundingSphere,
    translucent: boolean,
  ): DrawCommand {
    const renderState = this.#states.of(translucent ? "translucent" : "opaque");
    const pass = translucent ? Pass.TRANSLUCENT : Pass.OPAQUE;
    const changing = { shaderProgram: program, uniformMap, boundingVolume: sphere, renderState, pass };
    if (this.#command) return Object.assign(this.#command, changing);
    this.#command = new DrawCommand({
      ...changing,
      owner: this.#owner,
      vertexArray: this.#vertexArray(),
      primitiveType: PrimitiveType.TRIANGLE_STRIP,
      count: 4,
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
    this.#corners = this.#objects.vertexBuffer(CORNERS.byteLength);
    this.#objects.writeBuffer(this.#corners, CORNERS, 0);
    this.#array = this.#objects.vertexArray([
      { location: 0, buffer: this.#corners, numbers: "float32", components: 2, normalized: false },
    ]);
    return this.#array;
  }
}

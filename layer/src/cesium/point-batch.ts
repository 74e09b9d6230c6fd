import { BoundingSphere, Cartesian3, Interval, Matrix4, PrimitiveType } from "cesium";
import type { Program } from "../drawing/programs.js";
import { NODE_NUMBER } from "../effects/index.js";
import { BatchArray } from "./engine/batch-array.js";
import { DrawCommand, type RenderState, type UniformMap } from "./engine/cesium-private.js";
import type { CesiumTypes, GpuObjects } from "./engine/gpu-objects.js";
import { type CesiumNode, type NodeDrawable, PLACE } from "./node-drawable.js";

/** How nodes are drawn: by which program, where to, and with which values. */
export interface DrawState {
  readonly owner: object;
  readonly program: Program<CesiumTypes>;
  readonly renderState: RenderState;
  readonly uniformMap: UniformMap;
  /** One of Cesium's passes. */
  readonly pass: number;
}

/** A command that draws any number of nodes with one program. */
export class PointBatch {
  readonly #array: BatchArray;
  readonly #volume = new NodesVolume();
  #command: DrawCommand | undefined;
  /** What the list was filled with. */
  #nodes: readonly CesiumNode[] | undefined;
  #program: Program<CesiumTypes> | undefined;

  constructor({ context, draws }: Pick<GpuObjects, "context" | "draws">) {
    this.#array = new BatchArray(context, draws, NODE_NUMBER);
  }

  /**
   * The command, which draws these nodes from now on; Cesium derives those for depth, colour range and `scene.pick` from it.
   * @param nodes of one group, by rising row; the same array as before where they are as they were
   */
  command(nodes: readonly CesiumNode[], state: DrawState): DrawCommand {
    const { owner, program, renderState, uniformMap, pass } = state;
    if (nodes !== this.#nodes || program !== this.#program) {
      this.#nodes = nodes;
      this.#program = program;
      this.#array.list.fill(nodes, program.reads);
      this.#volume.hold(nodes);
    }
    const changing = { shaderProgram: program.program, renderState, uniformMap, pass };
    if (this.#command) return Object.assign(this.#command, changing);
    this.#command = new DrawCommand({
      ...changing,
      owner,
      vertexArray: this.#array,
      primitiveType: PrimitiveType.POINTS,
      count: 0,
      // The table of nodes says where each of them is.
      modelMatrix: Matrix4.IDENTITY,
      boundingVolume: this.#volume,
      pickId: "u_pickColor",
    });
    return this.#command;
  }
}

/**
 * Sphere around nodes, for Cesium to cull by. Near and far planes are fitted to the nodes themselves, since the sphere may
 * reach behind the camera where none of them does.
 */
export class NodesVolume extends BoundingSphere {
  /** x, y, z and radius of each sphere; longer than all of them, so that it serves many frames. */
  #balls = new Float64Array(0);
  #end = 0;

  /** Stands for the spheres of these nodes from now on. */
  hold(nodes: readonly { readonly uploaded: Pick<NodeDrawable, "places" | "slot"> }[]): void {
    this.#end = 4 * nodes.length;
    if (this.#balls.length < this.#end) this.#balls = new Float64Array(2 * this.#end);
    const balls = this.#balls;
    for (let index = 0, at = 0; index < nodes.length; index++, at += 4) {
      const { places, slot } = nodes[index].uploaded;
      const from = places.begin(slot) + PLACE.centre;
      for (let number = 0; number < 4; number++) balls[at + number] = places.numbers[from + number];
    }
    const x = this.#middle(0);
    const y = this.#middle(1);
    const z = this.#middle(2);
    Cartesian3.fromElements(x, y, z, this.center);
    // Not as narrow as Cesium's own, which takes many times as long.
    let reach = 0;
    for (let at = 0; at < this.#end; at += 4) {
      const east = balls[at] - x;
      const north = balls[at + 1] - y;
      const up = balls[at + 2] - z;
      reach = Math.max(reach, Math.sqrt(east * east + north * north + up * up) + balls[at + 3]);
    }
    this.radius = reach;
  }

  /** Least and greatest distance along a direction, metres. */
  override computePlaneDistances(
    position: Cartesian3,
    direction: Cartesian3,
    result = new Interval(),
  ): Interval {
    const balls = this.#balls;
    const { x, y, z } = direction;
    let start = Number.POSITIVE_INFINITY;
    let stop = Number.NEGATIVE_INFINITY;
    for (let at = 0; at < this.#end; at += 4) {
      const east = balls[at] - position.x;
      const north = balls[at + 1] - position.y;
      const up = balls[at + 2] - position.z;
      const along = x * east + y * north + z * up;
      start = Math.min(start, along - balls[at + 3]);
      stop = Math.max(stop, along + balls[at + 3]);
    }
    result.start = start;
    result.stop = stop;
    return result;
  }

  /** Middle of what the spheres take on an axis. */
  #middle(axis: number): number {
    const balls = this.#balls;
    let low = Number.POSITIVE_INFINITY;
    let high = Number.NEGATIVE_INFINITY;
    for (let at = 0; at < this.#end; at += 4) {
      low = Math.min(low, balls[at + axis] - balls[at + 3]);
      high = Math.max(high, balls[at + axis] + balls[at + 3]);
    }
    return (low + high) / 2;
  }
}

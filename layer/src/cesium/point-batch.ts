import { BoundingSphere, Cartesian3, Interval, Matrix4, PrimitiveType } from "cesium";
import type { Program } from "../drawing/programs.js";
import { NODE_NUMBER } from "../effects/index.js";
import { BatchArray } from "./engine/batch-array.js";
import { DrawCommand, type RenderState, type UniformMap } from "./engine/cesium-private.js";
import type { CesiumTypes, GpuObjects } from "./engine/gpu-objects.js";
import type { CesiumNode } from "./node-drawable.js";

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
      this.#volume.hold(nodes.map(({ uploaded }) => uploaded.sphere));
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

const interval = new Interval();

/**
 * Sphere around nodes, for Cesium to cull by. Near and far planes are fitted to the nodes themselves, since the sphere may
 * reach behind the camera where none of them does.
 */
export class NodesVolume extends BoundingSphere {
  #spheres: readonly BoundingSphere[] = [];

  /** Stands for these spheres from now on. */
  hold(spheres: readonly BoundingSphere[]): void {
    this.#spheres = spheres;
    const low = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY];
    const high = [Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const { center, radius } of spheres) {
      low[0] = Math.min(low[0], center.x - radius);
      low[1] = Math.min(low[1], center.y - radius);
      low[2] = Math.min(low[2], center.z - radius);
      high[0] = Math.max(high[0], center.x + radius);
      high[1] = Math.max(high[1], center.y + radius);
      high[2] = Math.max(high[2], center.z + radius);
    }
    const [x, y, z] = low.map((least, axis) => (least + high[axis]) / 2);
    Cartesian3.fromElements(x, y, z, this.center);
    // Not as narrow as Cesium's own, which takes many times as long.
    this.radius = 0;
    for (const { center, radius } of spheres) {
      this.radius = Math.max(this.radius, Cartesian3.distance(center, this.center) + radius);
    }
  }

  /** Least and greatest distance along a direction, metres. */
  override computePlaneDistances(
    position: Cartesian3,
    direction: Cartesian3,
    result = new Interval(),
  ): Interval {
    result.start = Number.POSITIVE_INFINITY;
    result.stop = Number.NEGATIVE_INFINITY;
    for (const sphere of this.#spheres) {
      const { start, stop } = sphere.computePlaneDistances(position, direction, interval);
      result.start = Math.min(result.start, start);
      result.stop = Math.max(result.stop, stop);
    }
    return result;
  }
}

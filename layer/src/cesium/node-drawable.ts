import { BoundingSphere, Cartesian3, Matrix4, PrimitiveType } from "cesium";
import type { DrawnNode } from "../drawing/drawn-node.js";
import type { Gpu } from "../drawing/gpu.js";
import { NodeBuffers } from "../drawing/node-buffers.js";
import type { UploadedNode } from "../drawing/node-uploads.js";
import type { Program } from "../drawing/programs.js";
import type { AttributeSet } from "../drawing/vertex-attributes.js";
import type { NodeVertices } from "../workers/index.js";
import { DrawCommand, type RenderState, type UniformMap } from "./engine/cesium-private.js";
import type { CesiumTypes } from "./engine/gpu-objects.js";

/** What a Cesium scene draws with. */
export interface CesiumView extends CesiumTypes {
  readonly node: NodeDrawable;
}

/** A node as a frame shows it in Cesium. */
export type CesiumNode = DrawnNode<CesiumView>;

/** How a node is drawn: by which program, where to, and with which values. */
export interface DrawState {
  readonly owner: object;
  readonly program: Program<CesiumTypes>;
  readonly renderState: RenderState;
  readonly uniformMap: UniformMap;
  /** One of Cesium's passes. */
  readonly pass: number;
}

/** A node on the GPU with two commands: one for Cesium's list, one for pictures of the layer's own. */
export class NodeDrawable extends NodeBuffers<CesiumTypes> implements UploadedNode {
  #place: ReturnType<typeof placeOf>;
  #sceneCommand: DrawCommand | undefined;
  #ownCommand: DrawCommand | undefined;

  /** @param heightOffset metres above its place at which it is drawn */
  constructor(gpu: Gpu<CesiumTypes>, vertices: NodeVertices, heightOffset: number) {
    super(gpu, vertices);
    this.#place = placeOf(vertices, heightOffset);
  }

  /** Sphere around the node as it is drawn, ECEF, metres. */
  get sphere(): BoundingSphere {
    return this.#place.boundingVolume;
  }

  /** The commands go too: those derived from them keep the programs and uniforms of all that was drawn last with them. */
  override keep(sets: readonly AttributeSet[]): void {
    super.keep(sets);
    this.#sceneCommand = undefined;
    this.#ownCommand = undefined;
  }

  lift(heightOffset: number): void {
    this.#place = placeOf(this.vertices, heightOffset);
    if (this.#sceneCommand) Object.assign(this.#sceneCommand, this.#place);
    if (this.#ownCommand) Object.assign(this.#ownCommand, this.#place);
  }

  /** The command for Cesium's list; it derives those for depth, colour range and `scene.pick` from it. */
  sceneCommand(state: DrawState, count: number): DrawCommand {
    this.#sceneCommand = this.#command(this.#sceneCommand, state, count);
    return this.#sceneCommand;
  }

  /** A command that only the layer itself executes. */
  ownCommand(state: DrawState, count: number): DrawCommand {
    this.#ownCommand = this.#command(this.#ownCommand, state, count);
    return this.#ownCommand;
  }

  #command(command: DrawCommand | undefined, state: DrawState, count: number): DrawCommand {
    const { owner, program, renderState, uniformMap, pass } = state;
    const vertexArray = this.array(program.reads);
    const changing = { vertexArray, shaderProgram: program.program, renderState, uniformMap, pass, count };
    if (command) return Object.assign(command, changing);
    return new DrawCommand({
      ...changing,
      owner,
      primitiveType: PrimitiveType.POINTS,
      ...this.#place,
      pickId: "u_pickColor",
    });
  }
}

/** Where a command draws a node: so many metres above its place, along its own up. */
function placeOf(node: Pick<NodeVertices, "frame" | "box">, heightOffset: number) {
  const modelMatrix = matrixOf(node, heightOffset);
  return { modelMatrix, boundingVolume: sphereOf(node, modelMatrix) };
}

/**
 * Node frame → ECEF in float64; Cesium multiplies it with the view in float64 too.
 * @param heightOffset metres along the frame's up that are added, for looks only
 */
export function matrixOf(
  { frame: { rotation, origin } }: Pick<NodeVertices, "frame">,
  heightOffset = 0,
): Matrix4 {
  const [ex, ey, ez, nx, ny, nz, ux, uy, uz] = rotation;
  // The constructor takes rows.
  return new Matrix4(
    ...([ex, nx, ux, origin[0] + heightOffset * ux] as const),
    ...([ey, ny, uy, origin[1] + heightOffset * uy] as const),
    ...([ez, nz, uz, origin[2] + heightOffset * uz] as const),
    ...([0, 0, 0, 1] as const),
  );
}

/** Sphere around a node's box, ECEF, metres: what Cesium culls by and fits its near and far planes to. */
function sphereOf({ box }: Pick<NodeVertices, "box">, modelMatrix: Matrix4): BoundingSphere {
  const [minX, minY, minZ, maxX, maxY, maxZ] = box;
  const centre = new Cartesian3((minX + maxX) / 2, (minY + maxY) / 2, (minZ + maxZ) / 2);
  const radius = Math.hypot(maxX - minX, maxY - minY, maxZ - minZ) / 2;
  // A single point would have no sphere at all.
  return BoundingSphere.transform(new BoundingSphere(centre, Math.max(radius, 0.01)), modelMatrix);
}

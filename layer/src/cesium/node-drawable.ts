import { BoundingSphere, Cartesian3, Matrix4, PrimitiveType } from "cesium";
import type { NodeVertices } from "../workers/index.js";
import {
  type Buffer,
  DrawCommand,
  type RenderState,
  type UniformMap,
  type VertexArray,
} from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import type { PointProgram } from "./point-programs.js";
import { type AttributeSet, bufferAttribute, constantAttribute, POSITION } from "./vertex-attributes.js";

/** How a node is drawn: by which program, where to, and with which values. */
export interface NodeDress {
  readonly owner: object;
  readonly program: PointProgram;
  readonly renderState: RenderState;
  readonly uniformMap: UniformMap;
  /** One of Cesium's passes. */
  readonly pass: number;
}

/**
 * A node on the GPU: a buffer for its places and one for each attribute that is asked for, the vertex arrays that
 * programs read them through, and two commands: one for Cesium's list, one for pictures of the layer's own.
 */
export class NodeDrawable {
  readonly vertices: NodeVertices;
  readonly #objects: GpuObjects;
  readonly #buffers = new Map<string, Buffer>();
  readonly #arrays = new Map<string, { readonly array: VertexArray; readonly columns: readonly string[] }>();
  #place: ReturnType<typeof placeOf>;
  #sceneCommand: DrawCommand | undefined;
  #ownCommand: DrawCommand | undefined;
  #bytes = 0;

  /** @param heightOffset metres above its place at which it is drawn */
  constructor(objects: GpuObjects, vertices: NodeVertices, heightOffset: number) {
    this.#objects = objects;
    this.vertices = vertices;
    this.#place = placeOf(vertices, heightOffset);
  }

  /** Bytes on the GPU. */
  get bytes(): number {
    return this.#bytes;
  }

  /** Sphere around the node as it is drawn, ECEF, metres. */
  get sphere(): BoundingSphere {
    return this.#place.boundingVolume;
  }

  /** Whether programs that read these attributes can draw the node. */
  has({ signature }: AttributeSet): boolean {
    return this.#arrays.has(signature);
  }

  /** Puts on the GPU what programs with these attributes need. */
  upload(set: AttributeSet): void {
    this.#array(set);
  }

  /** Frees what none of these attributes reads. */
  keep(sets: readonly AttributeSet[]): void {
    const kept = new Set([POSITION, ...sets.flatMap(({ columns }) => columns)]);
    const unused = [...this.#buffers].filter(([column]) => !kept.has(column));
    if (unused.length === 0) return;
    for (const [signature, { array, columns }] of this.#arrays) {
      if (columns.every((column) => kept.has(column))) continue;
      this.#objects.free(array);
      this.#arrays.delete(signature);
    }
    for (const [column, buffer] of unused) {
      this.#buffers.delete(column);
      this.#bytes -= buffer.sizeInBytes;
      this.#objects.free(buffer);
    }
  }

  /** Draws the node so many metres above its place from now on. */
  lift(heightOffset: number): void {
    this.#place = placeOf(this.vertices, heightOffset);
    if (this.#sceneCommand) Object.assign(this.#sceneCommand, this.#place);
    if (this.#ownCommand) Object.assign(this.#ownCommand, this.#place);
  }

  /** The command for Cesium's list; it derives those for depth, colour range and `scene.pick` from it. */
  sceneCommand(dress: NodeDress, count: number): DrawCommand {
    this.#sceneCommand = this.#command(this.#sceneCommand, dress, count);
    return this.#sceneCommand;
  }

  /** A command that only the layer itself executes. */
  ownCommand(dress: NodeDress, count: number): DrawCommand {
    this.#ownCommand = this.#command(this.#ownCommand, dress, count);
    return this.#ownCommand;
  }

  /** Frees all that the node has on the GPU. */
  destroy(): void {
    for (const { array } of this.#arrays.values()) this.#objects.free(array);
    for (const buffer of this.#buffers.values()) this.#objects.free(buffer);
    this.#arrays.clear();
    this.#buffers.clear();
    this.#bytes = 0;
  }

  #command(command: DrawCommand | undefined, dress: NodeDress, count: number): DrawCommand {
    const { owner, program, renderState, uniformMap, pass } = dress;
    const vertexArray = this.#array(program.reads);
    const shaderProgram = program.program;
    if (command)
      return Object.assign(command, { vertexArray, shaderProgram, renderState, uniformMap, pass, count });
    return new DrawCommand({
      owner,
      vertexArray,
      shaderProgram,
      renderState,
      uniformMap,
      pass,
      count,
      primitiveType: PrimitiveType.POINTS,
      ...this.#place,
      pickId: "u_pickColor",
    });
  }

  #array({ attributes, columns, signature }: AttributeSet): VertexArray {
    const found = this.#arrays.get(signature);
    if (found) return found.array;
    const made = attributes.map((attribute) => {
      const buffer = this.#buffer(attribute.column);
      const data = this.#data(attribute.column);
      return buffer && data
        ? bufferAttribute(attribute, buffer, data)
        : constantAttribute(attribute, this.vertices.columns[attribute.column]);
    });
    const array = this.#objects.vertexArray(made);
    this.#arrays.set(signature, { array, columns });
    return array;
  }

  #buffer(column: string): Buffer | undefined {
    const found = this.#buffers.get(column);
    if (found) return found;
    const data = this.#data(column);
    if (!data) return undefined;
    const buffer = this.#objects.vertexBuffer(data);
    this.#buffers.set(column, buffer);
    this.#bytes += buffer.sizeInBytes;
    return buffer;
  }

  /** The numbers of a column; undefined where all points share one value. */
  #data(column: string) {
    if (column === POSITION) return this.vertices.positions;
    const data = this.vertices.columns[column]?.data;
    return data && data.length > 0 ? data : undefined;
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

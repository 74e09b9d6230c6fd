import { BoundingSphere, Cartesian3, ComponentDatatype, Matrix4, PrimitiveType } from "cesium";
import { type NodeVertices, VERTEX_STRIDE } from "../workers/index.js";
import {
  Buffer,
  BufferUsage,
  type Context,
  DrawCommand,
  Pass,
  type RenderState,
  type ShaderProgram,
  type UniformMap,
  VertexArray,
} from "./cesium-private.js";
import { ATTRIBUTE_LOCATIONS } from "./shaders.js";

/** What all nodes of a layer are drawn with. */
export interface DrawShared {
  readonly owner: object;
  readonly shaderProgram: ShaderProgram;
  readonly renderState: RenderState;
  readonly uniformMap: UniformMap;
}

/** A node on the GPU: one buffer, and the command that draws it. */
export interface NodeDrawable {
  readonly command: DrawCommand;
  readonly count: number;
  readonly bytes: number;
  /** Draws the node so many metres above its place from now on. */
  lift(heightOffset: number): void;
  /** Frees the buffer. */
  destroy(): void;
}

/**
 * Puts a node's vertices on the GPU.
 * @param heightOffset metres above its place at which it is drawn
 */
export function createDrawable(
  context: Context,
  node: NodeVertices,
  shared: DrawShared,
  heightOffset: number,
): NodeDrawable {
  const vertexBuffer = Buffer.createVertexBuffer({
    context,
    typedArray: new Uint8Array(node.vertices),
    usage: BufferUsage.STATIC_DRAW,
  });
  const vertexArray = new VertexArray({ context, attributes: attributesOf(vertexBuffer) });
  const { frame, box, count, vertices } = node;
  const command = new DrawCommand({
    ...shared,
    vertexArray,
    primitiveType: PrimitiveType.POINTS,
    count,
    pass: Pass.OPAQUE,
    ...placeOf({ frame, box }, heightOffset),
    pickId: "u_pickColor",
  });
  return {
    command,
    count,
    bytes: vertices.byteLength,
    lift: (metres) => void Object.assign(command, placeOf({ frame, box }, metres)),
    destroy: () => vertexArray.destroy(),
  };
}

/** The interleaved layout of `NodeVertices.vertices` in WebGL's terms. */
function attributesOf(vertexBuffer: ReturnType<typeof Buffer.createVertexBuffer>) {
  const attribute = (
    index: number,
    componentsPerAttribute: number,
    componentDatatype: number,
    normalize: boolean,
    offsetInBytes: number,
  ) => ({
    index,
    vertexBuffer,
    componentsPerAttribute,
    componentDatatype,
    normalize,
    offsetInBytes,
    strideInBytes: VERTEX_STRIDE,
  });
  const { FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT } = ComponentDatatype;
  return [
    attribute(ATTRIBUTE_LOCATIONS.a_position, 3, FLOAT, false, 0),
    attribute(ATTRIBUTE_LOCATIONS.a_color, 4, UNSIGNED_BYTE, true, 12),
    attribute(ATTRIBUTE_LOCATIONS.a_intensity, 1, UNSIGNED_SHORT, true, 16),
    attribute(ATTRIBUTE_LOCATIONS.a_elevation, 1, UNSIGNED_SHORT, true, 18),
  ];
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

import { BoundingSphere, Cartesian3, Matrix4 } from "cesium";
import type { DrawnNode } from "../drawing/drawn-node.js";
import type { DrawnVertices } from "../drawing/drawn-vertices.js";
import type { UploadedNode } from "../drawing/node-uploads.js";
import { PagedNode } from "../drawing/paged-node.js";
import type { VertexPages } from "../drawing/vertex-pages.js";
import type { CesiumTypes } from "./engine/gpu-objects.js";

/** What a Cesium scene draws with. */
export interface CesiumView extends CesiumTypes {
  readonly node: NodeDrawable;
}

/** A node as a frame shows it in Cesium. */
export type CesiumNode = DrawnNode<CesiumView>;

/** A node on the GPU, and where it is. */
export class NodeDrawable extends PagedNode<CesiumTypes> implements UploadedNode {
  #place: ReturnType<typeof placeOf>;

  /** @param heightOffset metres above its place at which it is drawn */
  constructor(pages: VertexPages<CesiumTypes>, vertices: DrawnVertices, heightOffset: number) {
    super(pages, vertices);
    this.#place = placeOf(vertices, heightOffset);
  }

  /** Node frame → ECEF, as it is drawn. */
  get modelMatrix(): Matrix4 {
    return this.#place.modelMatrix;
  }

  /** Positions as they are stored → ECEF, column by column: what its product with the view is formed from. */
  get toGlobe(): readonly number[] {
    return this.#place.toGlobe;
  }

  /** Sphere around the node as it is drawn, ECEF, metres. */
  get sphere(): BoundingSphere {
    return this.#place.sphere;
  }

  lift(heightOffset: number): void {
    this.#place = placeOf(this.vertices, heightOffset);
  }
}

/** Where a node is drawn: so many metres above its place, along its own up. */
function placeOf(node: Pick<DrawnVertices, "frame" | "box" | "step">, heightOffset: number) {
  const modelMatrix = matrixOf(node, heightOffset);
  const { step = 1 } = node;
  const toGlobe = Matrix4.toArray(modelMatrix).map((value, at) => (at < 12 ? step * value : value));
  return { modelMatrix, toGlobe, sphere: sphereOf(node, modelMatrix) };
}

/**
 * Node frame → ECEF in float64; it is multiplied with the view in float64 too.
 * @param heightOffset metres along the frame's up that are added, for looks only
 */
export function matrixOf(
  { frame: { rotation, origin } }: Pick<DrawnVertices, "frame">,
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

/**
 * Writes the product of two affine matrices, which are given column by column, row by row from a component on: stored
 * positions → eye, composed in float64 and only then rounded.
 * @param view ECEF → eye
 * @param model positions as they are stored → ECEF
 */
export function writeToEye(
  view: readonly number[],
  model: readonly number[],
  table: Float32Array,
  at: number,
): void {
  for (let row = 0; row < 3; row++) {
    const x = view[row];
    const y = view[row + 4];
    const z = view[row + 8];
    const to = at + 4 * row;
    table[to] = x * model[0] + y * model[1] + z * model[2];
    table[to + 1] = x * model[4] + y * model[5] + z * model[6];
    table[to + 2] = x * model[8] + y * model[9] + z * model[10];
    table[to + 3] = x * model[12] + y * model[13] + z * model[14] + view[row + 12];
  }
}

/** Sphere around a node's box, ECEF, metres: what Cesium culls by and fits its near and far planes to. */
function sphereOf({ box }: Pick<DrawnVertices, "box">, modelMatrix: Matrix4): BoundingSphere {
  const [minX, minY, minZ, maxX, maxY, maxZ] = box;
  const centre = new Cartesian3((minX + maxX) / 2, (minY + maxY) / 2, (minZ + maxZ) / 2);
  const radius = Math.hypot(maxX - minX, maxY - minY, maxZ - minZ) / 2;
  // A single point would have no sphere at all.
  return BoundingSphere.transform(new BoundingSphere(centre, Math.max(radius, 0.01)), modelMatrix);
}

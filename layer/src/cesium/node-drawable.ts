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

/** Where the numbers of a place stand, from the first of its node on: see {@link NodePlaces}. */
export const PLACE = { toGlobe: 0, centre: 12, radius: 15 } as const;

/**
 * Where nodes are drawn, in one array of numbers by the slots of the nodes, since all of them are read in each frame of a view that
 * moves: three rows of the matrix that takes positions as they are stored to ECEF, then the sphere around the node, ECEF, metres.
 */
export class NodePlaces {
  #numbers = new Float64Array(0);

  /** The numbers of all slots; another array once there are more nodes. */
  get numbers(): Float64Array {
    return this.#numbers;
  }

  /** First number of a slot. */
  begin(slot: number): number {
    return 16 * slot;
  }

  write(slot: number, modelMatrix: Matrix4, step: number, { center, radius }: BoundingSphere): void {
    const begin = this.begin(slot);
    if (begin + 16 > this.#numbers.length) {
      const before = this.#numbers;
      this.#numbers = new Float64Array(2 * begin + 16);
      this.#numbers.set(before);
    }
    const numbers = this.#numbers;
    const columns = Matrix4.toArray(modelMatrix);
    for (let row = 0; row < 3; row++) {
      for (let column = 0; column < 4; column++) {
        const value = columns[4 * column + row];
        numbers[begin + PLACE.toGlobe + 4 * row + column] = column < 3 ? step * value : value;
      }
    }
    numbers[begin + PLACE.centre] = center.x;
    numbers[begin + PLACE.centre + 1] = center.y;
    numbers[begin + PLACE.centre + 2] = center.z;
    numbers[begin + PLACE.radius] = radius;
  }
}

/** A node on the GPU, and where it is. */
export class NodeDrawable extends PagedNode<CesiumTypes> implements UploadedNode {
  /** Where it and its neighbours are drawn. */
  readonly places: NodePlaces;
  #modelMatrix: Matrix4;
  #sphere: BoundingSphere;

  /**
   * @param slot its own in `places`
   * @param heightOffset metres above its place at which it is drawn
   */
  constructor(
    pages: VertexPages<CesiumTypes>,
    vertices: DrawnVertices,
    slot: number,
    places: NodePlaces,
    heightOffset: number,
  ) {
    super(pages, vertices, slot);
    this.places = places;
    this.#modelMatrix = matrixOf(vertices, heightOffset);
    this.#sphere = sphereOf(vertices, this.#modelMatrix);
    this.#writePlace();
  }

  /** Node frame → ECEF, as it is drawn. */
  get modelMatrix(): Matrix4 {
    return this.#modelMatrix;
  }

  /** Sphere around the node as it is drawn, ECEF, metres. */
  get sphere(): BoundingSphere {
    return this.#sphere;
  }

  lift(heightOffset: number): void {
    this.#modelMatrix = matrixOf(this.vertices, heightOffset);
    this.#sphere = sphereOf(this.vertices, this.#modelMatrix);
    this.#writePlace();
  }

  #writePlace(): void {
    this.places.write(this.slot, this.#modelMatrix, this.vertices.step ?? 1, this.#sphere);
  }
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
 * Writes the product of two affine matrices, row by row from a component on: stored positions → eye, composed in float64 and only
 * then rounded.
 * @param view ECEF → eye, column by column
 * @param numbers with three rows of the matrix that takes positions as they are stored to ECEF, from `from` on
 */
export function writeToEye(
  view: readonly number[],
  numbers: Float64Array,
  from: number,
  table: Float32Array,
  at: number,
): void {
  for (let row = 0; row < 3; row++) {
    const x = view[row];
    const y = view[row + 4];
    const z = view[row + 8];
    const to = at + 4 * row;
    table[to] = x * numbers[from] + y * numbers[from + 4] + z * numbers[from + 8];
    table[to + 1] = x * numbers[from + 1] + y * numbers[from + 5] + z * numbers[from + 9];
    table[to + 2] = x * numbers[from + 2] + y * numbers[from + 6] + z * numbers[from + 10];
    table[to + 3] = x * numbers[from + 3] + y * numbers[from + 7] + z * numbers[from + 11] + view[row + 12];
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

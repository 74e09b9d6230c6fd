import type { VoxelKey } from "../octree/index.js";
import type { PointSource } from "../sources/contract/point-source.js";
import { cubeSlack } from "../workers/index.js";

/** Cube of a node in source coordinates: min x, y, z and edge. */
export function nodeCube(
  [minX, minY, minZ, whole]: PointSource["cube"],
  { depth, x, y, z }: VoxelKey,
): [number, number, number, number] {
  const edge = whole / 2 ** depth;
  return [minX + x * edge, minY + y * edge, minZ + z * edge, edge];
}

/**
 * Box in source coordinates that all points of a node lie in, those of writers that round differently too: the cube
 * and the slack that decoded points have. Nothing is taken from the bounding box, which a header may have wrong.
 * @param out receives min x, y, z, max x, y, z
 */
export function pointBox(
  { cube, scale }: Pick<PointSource, "cube" | "scale">,
  key: VoxelKey,
  out: Float64Array,
): Float64Array {
  const [x, y, z, edge] = nodeCube(cube, key);
  for (const [axis, least] of [x, y, z].entries()) {
    const slack = cubeSlack(edge, scale[axis]);
    out[axis] = least - slack;
    out[axis + 3] = least + edge + slack;
  }
  return out;
}

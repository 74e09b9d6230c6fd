import { Cartesian3, Matrix4 } from "cesium";
import type { NodeDrawable } from "./node-drawable.js";

/**
 * Where the points of nodes are drawn that lie within a radius of a place: x, y, z of each, ECEF, metres. In each node the
 * place is brought into its frame, so that nothing is done for other points but three differences.
 * @param place ECEF, metres
 * @param radius metres
 */
export function pointsNear(
  place: Cartesian3,
  radius: number,
  nodes: Iterable<Pick<NodeDrawable, "modelMatrix" | "sphere" | "vertices">>,
): number[] {
  const found: number[] = [];
  const most = radius * radius;
  for (const { modelMatrix, sphere, vertices } of nodes) {
    if (Cartesian3.distance(place, sphere.center) > sphere.radius + radius) continue;
    const { positions } = vertices;
    const inverse = Matrix4.inverseTransformation(modelMatrix, new Matrix4());
    const { x, y, z } = Matrix4.multiplyByPoint(inverse, place, new Cartesian3());
    for (let at = 0; at + 2 < positions.length; at += 3) {
      const dx = positions[at] - x;
      const dy = positions[at + 1] - y;
      const dz = positions[at + 2] - z;
      if (dx * dx + dy * dy + dz * dz > most) continue;
      const drawn = drawnPlace(modelMatrix, positions, at);
      found.push(drawn.x, drawn.y, drawn.z);
    }
  }
  return found;
}

/** Where a vertex of a node is drawn, ECEF. @param at of its x among the positions */
export function drawnPlace(modelMatrix: Matrix4, positions: ArrayLike<number>, at: number): Cartesian3 {
  const place = new Cartesian3(positions[at], positions[at + 1], positions[at + 2]);
  return Matrix4.multiplyByPoint(modelMatrix, place, place);
}

import { placeVertex, type Vertex } from "../measure/index.js";
import type { ScreenPoint } from "./view-adapter.js";

/** Pixels beyond any view. */
const FAR = 20_000;

/**
 * What a ring encloses that goes around a pole, on a map that shows the pole nowhere: the way around, and from both of its ends
 * on to the pole, beyond the edge of the map.
 * @param way places of its edges; the last is the first vertex once more, as it is seen after all others
 * @param project where the view shows a vertex, near another place
 * @returns undefined where the way ends where it began
 */
export function aroundPole(
  vertices: readonly Vertex[],
  way: readonly (ScreenPoint | undefined)[],
  project: (vertex: Vertex, near: ScreenPoint) => ScreenPoint | undefined,
): readonly ScreenPoint[] | undefined {
  const [begin, end] = [way[0], way[way.length - 1]];
  if (!begin || !end || Math.hypot(end.x - begin.x, end.y - begin.y) < 1) return undefined;
  const { longitude, latitude } = vertices[0];
  const pole = vertices.reduce((sum, one) => sum + one.latitude, 0) < 0 ? -1 : 1;
  const nearer = latitude + (pole * (Math.PI / 2 - pole * latitude)) / 10;
  const ahead = project(placeVertex(longitude, nearer, 0), begin);
  if (!ahead) return undefined;
  const [x, y] = [ahead.x - begin.x, ahead.y - begin.y];
  const far = FAR / Math.hypot(x, y);
  const beyond = (place: ScreenPoint) => ({ x: place.x + far * x, y: place.y + far * y });
  return [...way.filter((place) => place !== undefined), beyond(end), beyond(begin)];
}

import type { PlacingFacts, PointFilter, SceneFacts, StyledAttribute } from "../effects/index.js";
import { pixelsPerMetre, type Selection } from "../octree/index.js";
import type { FrameCamera } from "./frame-camera.js";
import { Extent, type NodeShape, spacingFacts } from "./spacing-facts.js";

/** Bits of the depth buffers that are drawn with. */
const DEPTH_BITS = 24;

/** What a layer knows besides the frame. */
export interface LayerFacts {
  readonly attributes: readonly StyledAttribute[];
  /** Volumes that cut, and volumes that highlight. */
  readonly clips: number;
  readonly highlights: number;
  readonly filter: PointFilter | undefined;
  readonly silhouettes: number | undefined;
  readonly placing: PlacingFacts | undefined;
}

/**
 * The numbers that the magnitudes of effects are computed from. What is done for each node makes no objects and looks nothing
 * up: a view that moves needs it in every frame, of a thousand nodes or more.
 * @param shapes of the selection's nodes, at the same indices, as far as they are here
 */
export function sceneFacts(
  camera: FrameCamera,
  selection: Selection,
  shapes: readonly (NodeShape | undefined)[],
  layer: LayerFacts,
): SceneFacts {
  const { view, pixelRatio } = camera;
  const { nodes, points } = selection;
  return {
    viewportHeight: view.height,
    pixelRatio,
    nodes: nodes.length,
    points,
    ...spacingFacts(camera, selection, shapes),
    ...depthFacts(camera, distances(camera, selection)),
    placingPixels: placingPixels(camera, shapes),
    ...layer,
  };
}

/** Least and greatest distance of nodes, metres. */
function distances({ view: { position }, near }: FrameCamera, { nodes }: Selection) {
  const distance = new Extent();
  for (let index = 0; index < nodes.length; index++) {
    const { bounds } = nodes[index];
    if (!bounds) continue;
    const x = bounds.x - position[0];
    const y = bounds.y - position[1];
    const z = bounds.z - position[2];
    // The root of the sum, since hypot is many times slower and nothing overflows here.
    const away = Math.sqrt(x * x + y * y + z * z);
    distance.add(Math.max(near, away - bounds.radius));
    distance.add(away + bounds.radius);
  }
  return distance.range;
}

/**
 * Steps of depth buffers at the far end of the points. Cesium's logarithmic depth, which points are shaded by, is
 * log(d)/log(f − n + 1) of d = z − n + 1, so that a step of 2⁻ᵇ is d·ln(f − n + 1)·2⁻ᵇ metres (`czm_writeLogDepth`);
 * an orthographic view's is linear, f − n metres over all steps. One that is linear in 1/z has z²/(n·2ᵇ) metres
 * (T. Akenine-Möller et al., "Real-Time Rendering", 4th ed., 4.7.2, with f ≫ n).
 */
function depthFacts(
  { view: { projection, height }, near: nearPlane, depth: { scene } }: FrameCamera,
  [near, far]: readonly [number, number],
) {
  const depth = far - near;
  const perspective = projection.kind === "perspective";
  const step = perspective ? (depth + 1) * Math.log(depth + 1) : depth;
  const linearStep = far ** 2 / (nearPlane * 2 ** DEPTH_BITS);
  const tangent = perspective ? Math.tan(projection.fieldOfView / 2) : 1;
  return {
    depthStep: depth > 0 ? step / far / 2 ** DEPTH_BITS : 0,
    ...(perspective && far > 0 && { depthStepPixels: (linearStep * height) / (2 * far * tangent) }),
    logarithmicDepth: scene,
  };
}

/** Unit roundoff of float32. */
const ROUNDOFF = 2 ** -24;

/**
 * What a drawn point may be off on screen, drawing-buffer pixels: of each node its certified bound, and what float32 costs on
 * the way from its frame to the eye, seen from as near as its box comes to the camera. Of four products with rounded factors
 * that is no more than 5 u per term (N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., 3.1).
 */
function placingPixels({ view, near }: FrameCamera, shapes: readonly (NodeShape | undefined)[]): number {
  const { position } = view;
  const perspective = view.projection.kind === "perspective";
  const metre = pixelsPerMetre(view);
  let greatest = 0;
  for (let index = 0; index < shapes.length; index++) {
    const shape = shapes[index];
    if (!shape) continue;
    const { box, bound } = shape;
    const { origin, rotation } = shape.frame;
    const x = position[0] - origin[0];
    const y = position[1] - origin[1];
    const z = position[2] - origin[2];
    let away = 0;
    let reach = 0;
    let range = 0;
    for (let axis = 0; axis < 3; axis++) {
      const low = box[axis];
      const high = box[axis + 3];
      // Of the eye in the node's frame.
      const at = rotation[3 * axis] * x + rotation[3 * axis + 1] * y + rotation[3 * axis + 2] * z;
      const outside = at < low ? low - at : at > high ? at - high : 0;
      const farthest = Math.max(Math.abs(low), Math.abs(high));
      away += outside * outside;
      reach += farthest * farthest;
      range += at * at;
    }
    const rounding = 5 * ROUNDOFF * (Math.sqrt(3 * reach) + Math.sqrt(range));
    const distance = perspective ? Math.max(near, Math.sqrt(away)) : 1;
    greatest = Math.max(greatest, ((bound + rounding) * metre) / distance);
  }
  return greatest;
}

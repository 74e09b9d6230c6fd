import type { PlacingFacts, PointFilter, SceneFacts, StyledAttribute } from "../effects/index.js";
import { pixelsPerMetre, type Selection, SHAPE, type ShapedPoints } from "../octree/index.js";
import type { FrameCamera } from "./frame-camera.js";
import { Extent, type NodesHere, spacingFacts } from "./spacing-facts.js";

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
 * @param here what is here of the selection's nodes
 * @param nearest is given how far away each node of the selection begins, metres: the near plane where that is farther
 */
export function sceneFacts(
  camera: FrameCamera,
  selection: Selection,
  here: NodesHere,
  layer: LayerFacts,
  nearest: Float32Array = new Float32Array(selection.nodes.length),
): SceneFacts {
  const { view, pixelRatio } = camera;
  const { nodes, points } = selection;
  return {
    viewportHeight: view.height,
    pixelRatio,
    nodes: nodes.length,
    points,
    ...spacingFacts(camera, selection, here),
    ...depthFacts(camera, distances(camera, selection, nearest)),
    placingPixels: placingPixels(camera, here),
    ...layer,
  };
}

/** Least and greatest distance of nodes, metres. */
function distances({ view, near }: FrameCamera, { nodes }: Selection, nearest: Float32Array) {
  const { position, direction } = view;
  const perspective = view.projection.kind === "perspective";
  const distance = new Extent();
  for (let index = 0; index < nodes.length; index++) {
    const { bounds } = nodes[index];
    if (!bounds) continue;
    const x = bounds.x - position[0];
    const y = bounds.y - position[1];
    const z = bounds.z - position[2];
    // The root of the sum, since hypot is many times slower and nothing overflows here.
    const away = Math.sqrt(x * x + y * y + z * z);
    const least = Math.max(near, away - bounds.radius);
    distance.add(least);
    distance.add(away + bounds.radius);
    const ahead = x * direction[0] + y * direction[1] + z * direction[2];
    nearest[index] = perspective ? least : Math.max(near, ahead - bounds.radius);
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
function placingPixels({ view, near }: FrameCamera, { slots, shapes }: NodesHere): number {
  const { position } = view;
  const perspective = view.projection.kind === "perspective";
  const metre = pixelsPerMetre(view);
  const { numbers } = shapes;
  let greatest = 0;
  for (let index = 0; index < slots.length; index++) {
    if (slots[index] < 0) continue;
    const begin = shapes.begin(slots[index]);
    const x = position[0] - numbers[begin + SHAPE.origin];
    const y = position[1] - numbers[begin + SHAPE.origin + 1];
    const z = position[2] - numbers[begin + SHAPE.origin + 2];
    const bound = numbers[begin + SHAPE.bound];
    const reach = numbers[begin + SHAPE.reachSquared];
    const range = Math.sqrt(x * x + y * y + z * z);
    const off = bound + rounding(reach, range);
    // No place of the box is nearer than the sphere around it: most nodes are less far off than one before them at any.
    const nearest = perspective ? Math.max(near, range - Math.sqrt(reach)) : 1;
    if (off * metre * SAFE < greatest * nearest) continue;
    const shape = shapes.points(slots[index]);
    if (!shape) continue;
    const distance = perspective ? Math.max(near, distanceToBox(shape, x, y, z)) : 1;
    greatest = Math.max(greatest, (off * metre) / distance);
  }
  return greatest;
}

/** More than what rounding to float64 may make of the comparison of two numbers. */
const SAFE = 1 + 1e-9;

/**
 * What float32 costs, metres.
 * @param reach sum of the squares of the greatest coordinates on each axis, square metres
 * @param range distance of the eye from the origin of the node's frame, metres
 */
function rounding(reach: number, range: number): number {
  return 5 * ROUNDOFF * (Math.sqrt(3 * reach) + range);
}

/** Distance of a node's box from a place that lies so far from the origin of its frame, metres: ECEF, or map. */
function distanceToBox({ box, frame: { rotation } }: ShapedPoints, x: number, y: number, z: number): number {
  let away = 0;
  for (let axis = 0; axis < 3; axis++) {
    const low = box[axis];
    const high = box[axis + 3];
    const at = rotation[3 * axis] * x + rotation[3 * axis + 1] * y + rotation[3 * axis + 2] * z;
    const outside = at < low ? low - at : at > high ? at - high : 0;
    away += outside * outside;
  }
  return Math.sqrt(away);
}

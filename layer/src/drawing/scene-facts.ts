import { pointIn } from "@groma/georef";
import type { PlacingFacts, PointFilter, SceneFacts, StyledAttribute } from "../effects/index.js";
import { pixelsPerMetre, type Selection } from "../octree/index.js";
import type { FrameCamera } from "./frame-camera.js";
import { Extent, spacingFacts, type VerticesOf } from "./spacing-facts.js";

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

/** The numbers that the magnitudes of effects are computed from. */
export function sceneFacts(
  camera: FrameCamera,
  selection: Selection,
  verticesOf: VerticesOf,
  layer: LayerFacts,
): SceneFacts {
  const { view, pixelRatio, near } = camera;
  const [cx, cy, cz] = Array.from(view.position);
  const { nodes, points } = selection;
  const distance = new Extent();
  for (const { bounds } of nodes) {
    if (!bounds) continue;
    const away = Math.hypot(bounds.x - cx, bounds.y - cy, bounds.z - cz);
    distance.add(Math.max(near, away - bounds.radius));
    distance.add(away + bounds.radius);
  }
  return {
    viewportHeight: view.height,
    pixelRatio,
    nodes: nodes.length,
    points,
    ...spacingFacts(camera, selection, verticesOf),
    ...depthFacts(camera, distance.range),
    placingPixels: placingPixels(camera, selection, verticesOf),
    ...layer,
  };
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
function placingPixels({ view, near }: FrameCamera, { nodes }: Selection, verticesOf: VerticesOf): number {
  const { position } = view;
  const perspective = view.projection.kind === "perspective";
  const metre = pixelsPerMetre(view);
  let greatest = 0;
  for (const node of nodes) {
    const vertices = verticesOf(node);
    if (!vertices) continue;
    const { box, bound, frame } = vertices;
    const eye = pointIn(frame, position[0], position[1], position[2]);
    let away = 0;
    let reach = 0;
    let range = 0;
    // Loops without arrays and without hypot: for a thousand nodes in each frame they would take half a millisecond.
    for (let axis = 0; axis < 3; axis++) {
      const low = box[axis];
      const high = box[axis + 3];
      const at = eye[axis];
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

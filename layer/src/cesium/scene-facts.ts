import { Cartesian3, OrthographicFrustum, PerspectiveFrustum } from "cesium";
import type { PlacingFacts, PointFilter, SceneFacts, StyledAttribute } from "../effects/index.js";
import type { OctreeNode, Selection } from "../octree/index.js";
import type { FrameState } from "./cesium-private.js";

/** Bits of the depth buffers that Cesium and the layer draw with. */
const DEPTH_BITS = 24;

/** What a layer knows besides the frame. */
export interface LayerFacts {
  readonly attributes: readonly StyledAttribute[];
  /** Volumes that cut, and volumes that highlight. */
  readonly clips: number;
  readonly highlights: number;
  readonly filter: PointFilter | undefined;
  readonly placing: PlacingFacts | undefined;
}

/** The numbers that the magnitudes of effects are computed from. */
export function sceneFacts(frameState: FrameState, selection: Selection, layer: LayerFacts): SceneFacts {
  const { context, pixelRatio, camera } = frameState;
  const { nodes, counts, points } = selection;
  const spacing = new Extent();
  const level = new Extent();
  const distance = new Extent();
  let finestSpacing = 0;
  const selected = new Set(nodes);
  nodes.forEach((node, index) => {
    const { bounds, key, pointCount } = node;
    if (bounds) {
      const away = Cartesian3.distance(camera.positionWC, bounds as unknown as Cartesian3);
      distance.add(Math.max(camera.frustum.near, away - bounds.radius));
      distance.add(away + bounds.radius);
      finestSpacing = finestSpacing === 0 ? bounds.spacing : Math.min(finestSpacing, bounds.spacing);
    }
    if (isCovered(node, selected)) return;
    level.add(key.depth);
    // One in n points of a surface lie √n as far apart.
    const apart = selection.spacings[index] * Math.sqrt(pointCount / counts[index]);
    if (Number.isFinite(apart)) spacing.add(apart);
  });
  return {
    viewportHeight: context.drawingBufferHeight,
    pixelRatio,
    nodes: nodes.length,
    points,
    spacings: spacing.range,
    levels: level.range,
    finestSpacing,
    ...depthFacts(frameState, distance.range),
    ...layer,
  };
}

/** Octants that a surface through a node passes. */
const OCTANTS_OF_SURFACE = 4;

/**
 * Whether a node's points lie among those of its children all over it. With fewer children than a surface has, the node
 * is the finest that is drawn in some part of it.
 */
function isCovered({ children = [] }: OctreeNode, nodes: ReadonlySet<OctreeNode>): boolean {
  const drawn = children.filter((child) => child !== undefined && nodes.has(child));
  return drawn.length >= OCTANTS_OF_SURFACE;
}

/**
 * Steps of depth buffers at the far end of the points. Cesium's logarithmic depth, which points are shaded by, is
 * log(d)/log(f − n + 1) of d = z − n + 1, so that a step of 2⁻ᵇ is d·ln(f − n + 1)·2⁻ᵇ metres (`czm_writeLogDepth`);
 * an orthographic view's is linear, f − n metres over all steps. One that is linear in 1/z has z²/(n·2ᵇ) metres
 * (T. Akenine-Möller et al., "Real-Time Rendering", 4th ed., 4.7.2, with f ≫ n).
 */
function depthFacts({ context, camera, useLogDepth }: FrameState, [near, far]: readonly [number, number]) {
  const { frustum } = camera;
  const orthographic = frustum instanceof OrthographicFrustum;
  const depth = far - near;
  const step = orthographic ? depth : (depth + 1) * Math.log(depth + 1);
  const tangent = Math.tan(((frustum instanceof PerspectiveFrustum && frustum.fovy) || Math.PI / 3) / 2);
  const linearStep = far ** 2 / (frustum.near * 2 ** DEPTH_BITS);
  return {
    depthStep: depth > 0 ? step / far / 2 ** DEPTH_BITS : 0,
    ...(!orthographic &&
      far > 0 && { depthStepPixels: (linearStep * context.drawingBufferHeight) / (2 * far * tangent) }),
    logarithmicDepth: useLogDepth,
  };
}

/** Least and greatest of what was added; 0 and 0 where nothing was. */
class Extent {
  #least = Number.POSITIVE_INFINITY;
  #greatest = Number.NEGATIVE_INFINITY;

  add(value: number): void {
    this.#least = Math.min(this.#least, value);
    this.#greatest = Math.max(this.#greatest, value);
  }

  get range(): readonly [number, number] {
    return this.#least <= this.#greatest ? [this.#least, this.#greatest] : [0, 0];
  }
}

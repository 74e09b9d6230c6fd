import type { NodeBounds } from "./octree-node.js";

/** A camera over the globe in plain numbers: float64, ECEF (EPSG:4978), metres; over a map, what `NodeBounds` has there. */
export interface View {
  /** Camera position, 3 numbers. */
  readonly position: ArrayLike<number>;
  /** Direction of view, unit vector, 3 numbers. */
  readonly direction: ArrayLike<number>;
  /** Planes of the frustum, 4 numbers each: n·p + d ≥ 0 inside, n of unit length. */
  readonly planes: ArrayLike<number>;
  /** Height of the picture in pixels. */
  readonly height: number;
  /** How lengths come to pixels. */
  readonly projection:
    | { readonly kind: "perspective" /** Vertical field of view, radians. */; readonly fieldOfView: number }
    | {
        readonly kind: "orthographic" /** Height of the picture on the ground, metres. */;
        readonly extent: number;
      };
  /** Whether the globe hides what lies behind its horizon. */
  readonly horizon: boolean;
}

/** Semi-axes of WGS84, metres (EPSG:7030). */
const SEMI_MAJOR = 6_378_137;
const SEMI_MINOR = 6_356_752.314245179;

/**
 * Metres by which the occluding ellipsoid is smaller than WGS84. Cesium shows what lies under its globe unless
 * asked to test against terrain, so a survey of the sea floor (deepest: about −11,000 m) must not be culled by
 * the water above it.
 */
const OCCLUDER_DEPTH = 12_000;

/** Distance from the camera to a node's sphere, metres; 0 inside. */
export function distanceTo(view: View, bounds: NodeBounds): number {
  return Math.max(0, distanceToMiddle(view, bounds) - bounds.radius);
}

/** Distance from the camera to the middle of a node's sphere, metres. */
export function distanceToMiddle({ position }: View, bounds: NodeBounds): number {
  const x = bounds.x - position[0];
  const y = bounds.y - position[1];
  const z = bounds.z - position[2];
  // The root of the sum, since hypot is many times slower and nothing overflows here.
  return Math.sqrt(x * x + y * y + z * z);
}

/** True where a node's sphere lies wholly on the outer side of a plane of the frustum. */
export function outsideFrustum(view: View, bounds: NodeBounds): boolean {
  const { planes } = view;
  for (let at = 0; at + 3 < planes.length; at += 4) {
    const distance =
      planes[at] * bounds.x + planes[at + 1] * bounds.y + planes[at + 2] * bounds.z + planes[at + 3];
    if (distance < -bounds.radius) return true;
  }
  return false;
}

/**
 * Says of a node's sphere whether the ellipsoid hides it wholly from a view. In coordinates divided by the semi-axes
 * the ellipsoid is the unit sphere; hidden is what lies behind the plane of the horizon and inside the cone of
 * tangents from the camera (P. Cozzi, K. Ring, "Horizon Culling", 2013). The sphere is taken as one with the
 * radius divided by the smaller semi-axis, which contains its image: the test never hides too much.
 */
export function horizonOf(view: View): (bounds: NodeBounds) => boolean {
  const a = SEMI_MAJOR - OCCLUDER_DEPTH;
  const b = SEMI_MINOR - OCCLUDER_DEPTH;
  const vx = view.position[0] / a;
  const vy = view.position[1] / a;
  const vz = view.position[2] / b;
  const height = Math.hypot(vx, vy, vz);
  if (!view.horizon || height <= 1) return () => false;
  const sine = 1 / height;
  const cosine = Math.sqrt(1 - sine * sine);
  const toHorizonPlane = height - sine;
  return ({ x, y, z, radius: metres }) => {
    const radius = metres / b;
    const wx = x / a - vx;
    const wy = y / a - vy;
    const wz = z / b - vz;
    // Along the axis from the camera to the centre of the earth, and away from it.
    const along = -(wx * vx + wy * vy + wz * vz) * sine;
    if (along - toHorizonPlane < radius) return false;
    const away = Math.sqrt(Math.max(0, wx * wx + wy * wy + wz * wz - along * along));
    return along * sine - away * cosine >= radius;
  };
}

/**
 * Pixels that a metre takes: at a metre from the camera in perspective, at any distance in an orthographic view.
 */
export function pixelsPerMetre({ projection, height }: View): number {
  if (projection.kind === "orthographic") return height / projection.extent;
  return height / (2 * Math.tan(projection.fieldOfView / 2));
}

import { eastNorthUp, PlacementError } from "@groma/georef";
import type { CameraView, PointCloudLayer } from "@groma/layer/cesium";
import { BoundingSphere, Cartesian3, HeadingPitchRange, PerspectiveFrustum, type Viewer } from "cesium";
import { fitView, type ScreenRectangle, viewWindow } from "./framing.js";

/** From where a cloud is looked at. */
export type Aspect = "oblique" | "above";

/** Heading clockwise from north and pitch up from the horizon, radians. */
const DIRECTIONS: Readonly<Record<Aspect, { heading: number; pitch: number }>> = {
  oblique: { heading: -0.3, pitch: -0.7 },
  above: { heading: 0, pitch: -Math.PI / 2 },
};

/** Seconds of a flight. */
const FLIGHT = 2;

/** How a camera goes to a cloud. */
export interface Flight {
  readonly aspect: Aspect;
  /** Part of the canvas that nothing lies over, CSS pixels. */
  readonly free: ScreenRectangle;
  /** `jump`: at once. `fly`: from where it is. `descend`: from far above the cloud. */
  readonly way: "jump" | "fly" | "descend";
}

/** A camera's place and axes, ECEF. */
interface Pose {
  readonly destination: Cartesian3;
  readonly orientation: { readonly direction: Cartesian3; readonly up: Cartesian3 };
}

/** Takes the camera to where it sees the whole cloud; resolves when it is there or was sent elsewhere. */
export function goToCloud(viewer: Viewer, layer: PointCloudLayer, flight: Flight): Promise<void> {
  const { camera } = viewer;
  const pose = poseFor(viewer, layer, flight);
  if (flight.way === "descend") camera.setView(farAbove(viewer, layer, flight));
  const duration = flight.way === "jump" ? 0 : FLIGHT;
  return new Promise((resolve) => {
    camera.flyTo({ ...pose, duration, complete: resolve, cancel: resolve });
  });
}

/** Takes the camera to where it sees places, ECEF, from the direction in which it looks. */
export function goToPlaces(
  { camera }: Viewer,
  places: readonly { readonly ecef: readonly [number, number, number] }[],
  way: Flight["way"],
): void {
  const points = places.map(({ ecef: [x, y, z] }) => new Cartesian3(x, y, z));
  const sphere = BoundingSphere.fromPoints(points);
  // Of one point nothing but its surroundings can be seen.
  sphere.radius = Math.max(sphere.radius, LEAST_RADIUS);
  const offset = new HeadingPitchRange(camera.heading, Math.min(camera.pitch, -0.3), 4 * sphere.radius);
  camera.flyToBoundingSphere(sphere, { duration: way === "jump" ? 0 : FLIGHT, offset });
}

/** Takes the camera to where one stood, which looked as that one did. */
export function goToView({ camera }: Viewer, view: CameraView, way: Flight["way"]): void {
  const { longitude, latitude, height, heading, pitch, roll } = view;
  camera.flyTo({
    destination: Cartesian3.fromRadians(longitude, latitude, height),
    orientation: { heading, pitch, roll },
    duration: way === "jump" ? 0 : FLIGHT,
  });
}

/** Metres around a place that are shown with it. */
const LEAST_RADIUS = 5;

/** Where a descent begins: over the cloud, so high that the shape of the earth shows. */
function farAbove(viewer: Viewer, layer: PointCloudLayer, flight: Flight): Pose {
  const { destination, orientation } = poseFor(viewer, layer, { ...flight, aspect: "above" });
  const { center } = layer.boundingSphere;
  const height = 20 * Cartesian3.distance(destination, center) + 500_000;
  const away = Cartesian3.multiplyByScalar(orientation.direction, -height, new Cartesian3());
  return { destination: Cartesian3.add(center, away, away), orientation };
}

function poseFor(viewer: Viewer, layer: PointCloudLayer, { aspect, free }: Flight): Pose {
  const { center } = layer.boundingSphere;
  const { right, up, forward } = axes(center, DIRECTIONS[aspect]);
  const along = cornersOf(layer).flatMap((corner) => {
    const away = Cartesian3.subtract(corner, center, new Cartesian3());
    return [right, up, forward].map((axis) => Cartesian3.dot(away, axis));
  });
  const { canvas, camera } = viewer;
  const size = { width: canvas.clientWidth, height: canvas.clientHeight };
  const { frustum } = camera;
  const fieldOfView = (frustum instanceof PerspectiveFrustum && frustum.fovy) || Math.PI / 3;
  const stand = fitView(along, viewWindow(free, size, fieldOfView), 5);
  const destination = Cartesian3.clone(center);
  for (const [axis, metres] of [
    [right, stand.right],
    [up, stand.up],
    [forward, -stand.back],
  ] as const) {
    Cartesian3.add(destination, Cartesian3.multiplyByScalar(axis, metres, new Cartesian3()), destination);
  }
  return { destination, orientation: { direction: forward, up } };
}

/** Axes of a camera in ECEF, by heading and pitch at a place. */
function axes(place: Cartesian3, { heading, pitch }: { heading: number; pitch: number }) {
  const { rotation } = eastNorthUp([place.x, place.y, place.z]);
  const local = (east: number, north: number, up: number) => {
    const row = (at: 0 | 1 | 2) =>
      east * (rotation[at] ?? 0) + north * (rotation[at + 3] ?? 0) + up * (rotation[at + 6] ?? 0);
    return new Cartesian3(row(0), row(1), row(2));
  };
  const forward = local(
    Math.cos(pitch) * Math.sin(heading),
    Math.cos(pitch) * Math.cos(heading),
    Math.sin(pitch),
  );
  const right = local(Math.cos(heading), -Math.sin(heading), 0);
  return { right, up: Cartesian3.cross(right, forward, new Cartesian3()), forward };
}

/**
 * Corners of the box that the file's header declares, as they are drawn, ECEF; of the bounding sphere where one of them
 * has no place.
 */
function cornersOf({ cloud, boundingSphere: { center, radius } }: PointCloudLayer): Cartesian3[] {
  const { min, max } = cloud.boundingBox;
  const { x: centreX, y: centreY, z: centreZ } = cloud.bounds;
  // What a height offset of the layer adds to all places.
  const lift = Cartesian3.subtract(center, new Cartesian3(centreX, centreY, centreZ), new Cartesian3());
  try {
    const corners: Cartesian3[] = [];
    for (const x of [min[0], max[0]]) {
      for (const y of [min[1], max[1]]) {
        for (const z of [min[2], max[2]]) {
          const place = Cartesian3.unpack([...cloud.place(x, y, z)]);
          corners.push(Cartesian3.add(place, lift, place));
        }
      }
    }
    return corners;
  } catch (thrown) {
    if (!(thrown instanceof PlacementError)) throw thrown;
  }
  return [-radius, radius].flatMap((away) =>
    [Cartesian3.UNIT_X, Cartesian3.UNIT_Y, Cartesian3.UNIT_Z].map((axis) =>
      Cartesian3.add(center, Cartesian3.multiplyByScalar(axis, away, new Cartesian3()), new Cartesian3()),
    ),
  );
}

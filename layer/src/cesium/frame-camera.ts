import { type Camera, OrthographicFrustum, PerspectiveFrustum } from "cesium";
import type { FrameCamera } from "../drawing/frame-camera.js";
import type { View } from "../octree/index.js";
import type { FrameState } from "./engine/cesium-private.js";
import { isOrthographic } from "./point-frustum.js";

/** Cesium's default vertical field of view, radians; for frusta that name none. */
const DEFAULT_FIELD_OF_VIEW = Math.PI / 3;

/** The camera of a frame. @param lift as {@link viewOfFrame} takes it */
export function cameraOfFrame(frameState: FrameState, lift: readonly [number, number, number]): FrameCamera {
  const { camera, context, pixelRatio, useLogDepth } = frameState;
  return {
    view: viewOfFrame(frameState, lift),
    width: context.drawingBufferWidth,
    pixelRatio,
    near: camera.frustum.near,
    depth: { own: !isOrthographic(camera.frustum), scene: useLogDepth },
    pose: () => poseOf(camera),
  };
}

/** Where a camera is and looks. */
function poseOf({ positionWC, directionWC, upWC }: Camera): number[] {
  return [positionWC, directionWC, upWC].flatMap(({ x, y, z }) => [x, y, z]);
}

/**
 * The camera of a frame in the plain numbers that the octree understands.
 * @param lift what is added to the places of the points as they are drawn, ECEF, metres; the octree knows the places
 *   themselves, so the camera is moved the other way
 */
export function viewOfFrame(frameState: FrameState, [x, y, z]: readonly [number, number, number]): View {
  const { camera, cullingVolume, context, occluder } = frameState;
  const { positionWC: position, directionWC: direction } = camera;
  return {
    position: [position.x - x, position.y - y, position.z - z],
    direction: [direction.x, direction.y, direction.z],
    planes: cullingVolume.planes.flatMap((plane) => [
      ...[plane.x, plane.y, plane.z],
      plane.w + plane.x * x + plane.y * y + plane.z * z,
    ]),
    height: context.drawingBufferHeight,
    projection: projectionOf(camera.frustum),
    horizon: occluder !== undefined,
  };
}

function projectionOf(frustum: unknown): View["projection"] {
  if (frustum instanceof OrthographicFrustum) {
    const { width = 1, aspectRatio = 1 } = frustum;
    return { kind: "orthographic", extent: width / aspectRatio };
  }
  const fieldOfView = frustum instanceof PerspectiveFrustum ? frustum.fovy : undefined;
  return { kind: "perspective", fieldOfView: fieldOfView ?? DEFAULT_FIELD_OF_VIEW };
}

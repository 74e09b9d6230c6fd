import { type Camera, Cartesian3 } from "cesium";
import type { CameraView } from "../every-view.js";

/** Where a camera stands and looks, to be kept in a link. */
export function cameraView({ positionCartographic, heading, pitch, roll }: Camera): CameraView {
  const { longitude, latitude, height } = positionCartographic;
  return { longitude, latitude, height, heading, pitch, roll };
}

/** Puts a camera there at once. */
export function showCameraView(camera: Camera, view: CameraView): void {
  const { longitude, latitude, height, heading, pitch, roll } = view;
  const destination = Cartesian3.fromRadians(longitude, latitude, height);
  camera.setView({ destination, orientation: { heading, pitch, roll } });
}

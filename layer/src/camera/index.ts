export { type Lens, type PictureHalves, placeInPicture, rayThrough, type ScreenPlace } from "./lens.js";
export { type CameraPose, headingAt, moveCamera, placeLookedAt, type Target } from "./pose.js";
export { alongRay, heightOf, horizonBelow, limbBeside, meetSurface, type Ray, upAt } from "./surface.js";
export { CAMERA_VIEW, type CameraView, HEIGHTS, isCameraView } from "./view.js";

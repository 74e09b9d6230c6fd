export {
  type CameraPose,
  headingAt,
  moveCamera,
  placeLookedAt,
  type Target,
} from "./camera.js";
export { footprintOf, type PictureHalves, ringOnMap } from "./footprint.js";
export {
  type GroundView,
  geodeticOf,
  type MapView,
  type Plane,
  placeOn,
  toGroundView,
  toMapView,
  unwrapped,
} from "./plane-view.js";
export { alongRay, heightOf, meetSurface, type Ray, upAt } from "./surface.js";

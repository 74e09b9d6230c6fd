export { footprintOf, ringOnMap } from "./footprint.js";
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

export {
  type DrawnCloud,
  layerView,
  readPermalink,
  type SharedView,
  type ViewedLayer,
  writePermalink,
} from "./permalink.js";
export type { SharedEquation, SharedProfile } from "./shared-profile.js";

export type { ScreenPlace } from "../camera/index.js";
export { NAVIGATION_KEYS } from "./keys.js";
export type {
  FlightOptions,
  NavigatedLayer,
  NavigatedViewer,
  NavigationMode,
  NavigationOptions,
  NavigationSettings,
} from "./options.js";
export { PointNavigation } from "./point-navigation.js";

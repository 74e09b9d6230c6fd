export { FARTHEST, keepClear } from "./clearance.js";
export { ALL_PITCHES, orbit, type PitchLimits, pitchOf } from "./orbit.js";
export { carried, type PanWay, panTo, panWay } from "./pan.js";
export { type Step, step } from "./step.js";
export { zoomAbout } from "./zoom.js";

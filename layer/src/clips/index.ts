export { type BoxClip, Clip, type ClipPlace, type PlaneClip, type PolygonClip } from "./clip.js";
export { CLIPS_OPTION, ClipSet } from "./clip-set.js";
export { type ClipTexture, ClipVolumes, clipTexture, type NodeClips } from "./clip-volumes.js";
export { checkClip, compileClip } from "./compile-clip.js";
export { type Corner, extendedPlace } from "./source-space.js";
export { finish, type Steps } from "./steps.js";
export type { ClipMode, ClipNode, SourceSpace, Volume } from "./volume.js";

/// <reference path="./three-chunk.d.ts" />
import threeCommon from "three/src/renderers/shaders/ShaderChunk/common.glsl.js";
import threeDithering from "three/src/renderers/shaders/ShaderChunk/dithering_pars_fragment.glsl.js";
import { CLIP_ROLES } from "../../clips/clip-roles.js";
import { CLASS_ENTRY } from "./class-entry.js";
import { GRADIENT } from "./gradient.js";
import { NEARER } from "./nearer.js";
import { PIXELS_PER_METRE } from "./pixels-per-metre.js";
import { TONE } from "./tone.js";
import { VISIBLE_OCTREE } from "./visible-octree.js";

/**
 * What shaders can `#include`. Of three.js, single files of chunks are imported: all of them in one object would be
 * 178 kB that no bundler can shake.
 */
export const CHUNKS: Readonly<Record<string, string>> = {
  classEntry: CLASS_ENTRY,
  clipRoles: CLIP_ROLES,
  gradient: GRADIENT,
  nearer: NEARER,
  pixelsPerMetre: PIXELS_PER_METRE,
  tone: TONE,
  visibleOctree: VISIBLE_OCTREE,
  "three/common": threeCommon,
  "three/dithering_pars_fragment": threeDithering,
};

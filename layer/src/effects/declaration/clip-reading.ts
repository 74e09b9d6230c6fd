import { CLIP_ROLES } from "../../clips/clip-roles.js";
import { CLIP_RECORDS, type UniformDeclaration } from "./shader.js";

/** What all effects of volumes share: what the point is to each record of its node. */
export const CLIP_READING = {
  uniforms: [
    { name: "u_clips", type: "sampler2D", scope: "texture" },
    { name: CLIP_RECORDS, type: "vec2", scope: "node" },
  ] satisfies UniformDeclaration[],
  functions: CLIP_ROLES,
  locate: "ivec4 roles = clipRoles($onGlobe);",
} as const;

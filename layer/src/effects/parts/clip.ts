import type { Effect } from "../effect.js";
import type { Part } from "../part.js";
import { rejectIf } from "../reject.js";

/** What all effects of volumes share: what the point is to each record of its node. */
export const CLIP_ROLES = {
  uniforms: [
    { name: "u_clips", type: "sampler2D", scope: "texture" },
    { name: "u_clipRecords", type: "vec2", scope: "node" },
  ],
  vertexFunctions: "#include <clipRoles>",
  locate: "ivec4 roles = clipRoles(a_position);",
} as const;

/** Volumes that cut (thesis, 5.3.3). */
export const clip: Effect = {
  name: "clip",
  unit: "1",
  threshold: 1,
  source: "number of volumes that cut (thesis, 5.3.3)",
  wish: ({ facts }) =>
    facts.clips > 0
      ? { kind: "asked", why: "volumes cut the scene" }
      : { kind: "off", why: "there is no volume that cuts" },
  magnitude: ({ facts }) => facts.clips,
  part: (): Part => ({
    uniforms: CLIP_ROLES.uniforms,
    vertexFunctions: CLIP_ROLES.vertexFunctions,
    vertex: {
      locate: CLIP_ROLES.locate,
      cull: rejectIf("roles.z > 0 || (roles.x > 0 && roles.y == 0)"),
    },
  }),
};

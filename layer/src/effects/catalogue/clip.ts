import { CLIP_READING } from "../declaration/clip-reading.js";
import { type Effect, rejectIf } from "../declaration/effect.js";

/** Volumes that cut (thesis, 5.3.3). */
export const clip: Effect<{ name: "clip" }> = {
  name: "clip",
  options: {},
  nodeTexture: "clips",
  forcible: "off",
  unit: "1",
  threshold: 1,
  source: "number of volumes that cut (thesis, 5.3.3)",
  wish: ({ facts }) =>
    facts.clips > 0
      ? { kind: "asked", why: "volumes cut the scene" }
      : { kind: "off", why: "there is no volume that cuts" },
  magnitude: ({ facts }) => facts.clips,
  part: () => ({
    uniforms: CLIP_READING.uniforms,
    vertexFunctions: [CLIP_READING.functions],
    vertex: {
      locate: CLIP_READING.locate,
      cull: rejectIf("roles.z > 0 || (roles.x > 0 && roles.y == 0)"),
    },
  }),
};

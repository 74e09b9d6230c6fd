import { shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { eyeDomeOf } from "../style.js";

/** The empirical factor of eq. 4.6. */
const BASE_STRENGTH = 300;

/** Shading by differences of depth, in a pass of its own (thesis, 4.4). */
export const eyeDomeLighting: Effect = {
  name: "eyeDomeLighting",
  unit: "share",
  threshold: 0.01,
  source:
    "share of pixels whose depth steps by 1 % or more, where measured; else the share of colour that does not show the shape (thesis, eq. 4.5)",
  wish({ style, facts }) {
    if (style.eyeDomeLighting === false) return { kind: "off", why: "the style does not ask for it" };
    return style.eyeDomeLighting === "auto"
      ? {
          kind: "auto",
          why:
            facts.silhouettes === undefined
              ? "colours do not show the shape; how much depth steps is not measured yet"
              : "depth steps, as measured in the picture",
        }
      : { kind: "forced", why: "the style asks for it" };
  },
  magnitude: (scene) => scene.facts.silhouettes ?? 1 - shareOf(scene, "own"),
  values({ style, facts }) {
    const { strength, radius } = eyeDomeOf(style);
    // Steps of the depth buffer are no shape: a plane seen face on must stay as it is.
    const floor = 2 * Math.log2(1 + facts.depthStep);
    return { u_eyeDome: [BASE_STRENGTH * strength, radius * facts.pixelRatio, floor] };
  },
};

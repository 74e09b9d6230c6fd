import { either, number, oneOf, parts } from "../../options/index.js";
import { RGB, shareOf } from "../declaration/colouring.js";
import type { Effect } from "../declaration/effect.js";
import { onOffOrAuto, option } from "../declaration/option.js";

/** Eye-Dome Lighting in numbers (thesis, 4.4). */
export interface EyeDomeLighting {
  /** `edlStrength` of eq. 4.6, 0 to 10. Default: 0.4. */
  readonly strength: number;
  /** Distance of the neighbours, CSS pixels, 0.5 to 20. Default: 1.4. */
  readonly radius: number;
  /** Default: 4. */
  readonly neighbours: 4 | 8;
}

/** Shading by depth in a style. */
export interface EyeDomeStyle {
  /**
   * Shading by depth (thesis, 4.4); `auto`: where colours do not show the shape. Numbers that are left out stay as they
   * are; where none were given, they are the defaults. Default: false.
   */
  readonly eyeDomeLighting: boolean | "auto" | EyeDomeLighting;
}

const DEFAULTS: EyeDomeLighting = { strength: 0.4, radius: 1.4, neighbours: 4 };

const numbers = parts<EyeDomeLighting>(
  { strength: number(0, 10), radius: number(0.5, 20), neighbours: oneOf(4, 8) },
  DEFAULTS,
);

/** The numbers of Eye-Dome Lighting that a style asks for, on or off. */
export function eyeDomeOf({ eyeDomeLighting }: EyeDomeStyle): EyeDomeLighting {
  return typeof eyeDomeLighting === "object" ? eyeDomeLighting : DEFAULTS;
}

/** The empirical factor of eq. 4.6. */
const BASE_STRENGTH = 300;

/**
 * Response of Eye-Dome Lighting (thesis, eq. 4.5) on log2 of the eye depth. Without perspective, depth has no ratio
 * that a shape could be seen by: it is taken against the distance from which a view of 60° would show as much,
 * √3 times half the picture's height, and its derivative there is that of the logarithm. Where no point was drawn there
 * is no depth to compare with: the background neither darkens nor is darkened.
 */
const RESPONSE = `
float relief(float depth) {
  float z = -eyeZ(depth);
  return $projection[3][3] == 0.0 ? log2(max(z, 1e-6)) : z * $projection[1][1] * ${(1 / (Math.sqrt(3) * Math.LN2)).toFixed(6)};
}
float response(vec2 place, vec2 step, float own) {
  float depth = texture(u_depth, place + step).r;
  if (depth >= 1.0) return 0.0;
  return max(0.0, own - relief(depth) - u_eyeDome.z);
}
`;

const BESIDE = ["1.0, 0.0", "-1.0, 0.0", "0.0, 1.0", "0.0, -1.0"];
const DIAGONAL = ["0.707107, 0.707107", "-0.707107, 0.707107", "0.707107, -0.707107", "-0.707107, -0.707107"];

/** Mean response and the shade of it (thesis, eq. 4.5 and 4.6). */
function shade(neighbours: 4 | 8): string {
  const directions = neighbours === 4 ? BESIDE : [...BESIDE, ...DIAGONAL];
  return [
    "vec2 reach = u_eyeDome.y / vec2(textureSize(u_depth, 0));",
    "float own = relief(depth);",
    "float sumOfSteps = 0.0;",
    ...directions.map(
      (direction) => `sumOfSteps += response(v_textureCoordinates, reach * vec2(${direction}), own);`,
    ),
    `color *= exp(-u_eyeDome.x * sumOfSteps / ${neighbours.toFixed(1)});`,
  ].join("\n");
}

/** Shading by differences of depth, in a pass of its own (thesis, 4.4). */
export const eyeDomeLighting: Effect<{ name: "eyeDomeLighting"; own: EyeDomeStyle; variant: 4 | 8 }> = {
  name: "eyeDomeLighting",
  pass: "quad",
  options: {
    eyeDomeLighting: option("STYLE_EYE_DOME", either(onOffOrAuto, numbers), false),
  },
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
  magnitude: (scene) => scene.facts.silhouettes ?? 1 - shareOf(scene, ({ effect }) => effect === RGB),
  variant: ({ style }) => eyeDomeOf(style).neighbours,
  quad: ({ target, variant }) => ({
    uniforms: [{ name: "u_eyeDome", type: "vec3", scope: "layer" }],
    functions: [target.eyeZ, RESPONSE],
    statements: { shade: shade(variant) },
  }),
  values({ style, facts }) {
    const { strength, radius } = eyeDomeOf(style);
    // Steps of the depth buffer are no shape: a plane seen face on must stay as it is.
    const floor = 2 * Math.log2(1 + facts.depthStep);
    return { u_eyeDome: [BASE_STRENGTH * strength, radius * facts.pixelRatio, floor] };
  },
};

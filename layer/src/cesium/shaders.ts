import type { ColourBy } from "./style.js";

/**
 * Colours of `viridis` at 0, 0.1 … 1, sRGB: S. van der Walt, N. Smith, "A Better Default Colormap for
 * Matplotlib", 2015 (CC0). Even in lightness, and told apart with any colour vision.
 */
export const VIRIDIS: readonly (readonly [number, number, number])[] = [
  [0x44, 0x01, 0x54],
  [0x48, 0x24, 0x75],
  [0x41, 0x44, 0x87],
  [0x35, 0x5f, 0x8d],
  [0x2a, 0x78, 0x8e],
  [0x21, 0x91, 0x8c],
  [0x22, 0xa8, 0x84],
  [0x44, 0xbf, 0x70],
  [0x7a, 0xd1, 0x51],
  [0xbd, 0xdf, 0x26],
  [0xfd, 0xe7, 0x25],
];

/** Where attributes of `NodeVertices.vertices` go in. */
export const ATTRIBUTE_LOCATIONS = { a_position: 0, a_color: 1, a_intensity: 2, a_elevation: 3 } as const;

const stops = VIRIDIS.map((colour) => `vec3(${colour.map((part) => (part / 255).toFixed(6)).join(", ")})`);

const RAMP = `
const vec3 RAMP[${VIRIDIS.length}] = vec3[](${stops.join(", ")});

vec3 ramp(float t) {
  float at = clamp(t, 0.0, 1.0) * ${(VIRIDIS.length - 1).toFixed(1)};
  int lower = min(int(at), ${VIRIDIS.length - 2});
  return mix(RAMP[lower], RAMP[lower + 1], at - float(lower));
}
`;

/** Per colouring: declarations, and the expression of a point's colour. */
const COLOURING: Readonly<Record<ColourBy, { declare: string; colour: string }>> = {
  rgb: { declare: "in vec4 a_color;", colour: "a_color.rgb" },
  elevation: { declare: `in float a_elevation;\n${RAMP}`, colour: "ramp(a_elevation)" },
  intensity: {
    declare: "in float a_intensity;\nuniform vec2 u_intensityRange;",
    colour:
      "vec3(clamp((a_intensity - u_intensityRange.x) / max(u_intensityRange.y - u_intensityRange.x, 1.5e-5), 0.0, 1.0))",
  },
};

/**
 * Vertex shader for one colouring; what it does not need is not in it. `czm_modelView` is the product node
 * frame → eye, formed in float64 before it is uploaded.
 */
export function vertexShader(colourBy: ColourBy): string {
  const { declare, colour } = COLOURING[colourBy];
  return `in vec3 a_position;
${declare}
uniform float u_pointSize;
out vec3 v_color;

void main() {
  v_color = ${colour};
  gl_Position = czm_projection * (czm_modelView * vec4(a_position, 1.0));
  gl_PointSize = u_pointSize * czm_pixelRatio;
}
`;
}

/** Fragment shader. Cesium derives the pick pass and logarithmic depth from it by itself. */
export const FRAGMENT_SHADER = `in vec3 v_color;
uniform vec4 u_pickColor;

void main() {
  out_FragColor = czm_gammaCorrect(vec4(v_color, 1.0));
}
`;

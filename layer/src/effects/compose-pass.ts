import { FRAGMENT_DEPTH } from "./chunks/fragment-depth.js";
import { shaderText } from "./compose.js";
import type { EffectPlan } from "./effect-plan.js";
import { DITHERING } from "./parts/dithering.js";
import type { QuadPass, QuadShader, ShaderTarget, UniformDeclaration } from "./shader-target.js";

/**
 * Eye coordinate z of a depth. In Cesium the points have a frustum of their own, whatever the scene is cut into: near
 * plane n, f − n, and log2(f − n + 1) where depth is Cesium's logarithmic one (`czm_writeLogDepth`), 0 where it is
 * linear (orthographic). Plain WebGL has the projection's.
 */
const EYE_Z: Readonly<Record<ShaderTarget, string>> = {
  cesium: `
float eyeZ(float depth) {
  float beyond = u_depthRange.z > 0.0 ? exp2(depth * u_depthRange.z) - 1.0 : depth * u_depthRange.y;
  return -(u_depthRange.x + beyond);
}
`,
  webgl2: `
float eyeZ(float depth) {
  float clip = 2.0 * depth - 1.0;
  return ($projection[3][2] - clip * $projection[3][3]) / (clip * $projection[2][3] - $projection[2][2]);
}
`,
};

/**
 * Response of Eye-Dome Lighting (thesis, eq. 4.5) on log2 of the eye depth. Without perspective, depth has no ratio
 * that a shape could be seen by: it is taken against the distance from which a view of 60° would show as much,
 * √3 times half the picture's height, and its derivative there is that of the logarithm. Where no point was drawn there
 * is no depth to compare with: the background neither darkens nor is darkened.
 */
const EYE_DOME = `
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

const DIRECTIONS: Readonly<Record<4 | 8, readonly string[]>> = {
  4: ["1.0, 0.0", "-1.0, 0.0", "0.0, 1.0", "0.0, -1.0"],
  8: [
    ...["1.0, 0.0", "-1.0, 0.0", "0.0, 1.0", "0.0, -1.0"],
    ...["0.707107, 0.707107", "-0.707107, 0.707107", "0.707107, -0.707107", "-0.707107, -0.707107"],
  ],
};

/** The depth in the scene's frustum; what lies in another of Cesium's frusta is drawn there. */
const DEPTH_OUTPUT: Readonly<Record<ShaderTarget, readonly string[]>> = {
  cesium: ["writeDepth(eyeZ(depth));", "if (gl_FragDepth < 0.0 || gl_FragDepth > 1.0) discard;"],
  webgl2: ["gl_FragDepth = depth;"],
};

const QUAD_VERTEX = `out vec2 v_textureCoordinates;

void main() {
  v_textureCoordinates = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * v_textureCoordinates - 1.0, 0.0, 1.0);
}
`;

/**
 * The fragment shader of a quad that puts points drawn offscreen into the scene, with their depth: `edl` shades them,
 * and normalises them where they are splats; `splatNormalise` only normalises. Its samplers are u_color and u_depth,
 * the colours and the depth of the passes before, of the picture's size and without filtering; u_depthRange says in
 * Cesium what the depths mean.
 */
export function composePass(pass: QuadPass, plan: EffectPlan, target: ShaderTarget): QuadShader {
  const lit = pass === "edl";
  const dithered = plan.active.has("dithering");
  const body = [
    "float depth = texture(u_depth, v_textureCoordinates).r;",
    "if (depth >= 1.0) discard;",
    "vec4 sum = texture(u_color, v_textureCoordinates);",
    ...(plan.active.has("splats")
      ? ["if (sum.a <= 0.0) discard;", "vec3 color = sum.rgb / sum.a;"]
      : ["vec3 color = sum.rgb;"]),
    ...(lit ? lighting(plan.neighbours) : []),
    target === "cesium"
      ? "out_FragColor = czm_gammaCorrect(vec4(color, 1.0));"
      : "out_FragColor = vec4(color, 1.0);",
    ...(plan.active.has("opacity") ? ["out_FragColor.a *= u_opacity;"] : []),
    ...(dithered ? [DITHERING.fragment.finish] : []),
    ...DEPTH_OUTPUT[target],
  ];
  const uniforms: UniformDeclaration[] = [
    { name: "u_color", type: "sampler2D", scope: "view" },
    { name: "u_depth", type: "sampler2D", scope: "view" },
    { name: "u_depthRange", type: "vec3", scope: "view" },
    { name: "u_eyeDome", type: "vec3", scope: "layer" },
    { name: "u_opacity", type: "float", scope: "layer" },
  ];
  const { text, uniforms: words } = shaderText(
    target,
    uniforms,
    [
      "in vec2 v_textureCoordinates;",
      ...(target === "webgl2" ? ["layout(location = 0) out vec4 out_FragColor;"] : []),
    ],
    [
      ...(lit || target === "cesium" ? [EYE_Z[target]] : []),
      ...(target === "cesium" ? [FRAGMENT_DEPTH.cesium] : []),
      ...(lit ? [EYE_DOME] : []),
      ...(dithered ? [DITHERING.fragmentFunctions] : []),
    ],
    body,
  );
  return {
    vertex: target === "webgl2" ? `#version 300 es\n${QUAD_VERTEX}` : "",
    fragment: text,
    uniforms: [...uniforms, ...words].filter(({ name }) => new RegExp(`\\b${name}\\b`).test(text)),
  };
}

/** Mean response and the shade of it (thesis, eq. 4.5 and 4.6). */
function lighting(neighbours: 4 | 8): string[] {
  return [
    "vec2 reach = u_eyeDome.y / vec2(textureSize(u_depth, 0));",
    "float own = relief(depth);",
    "float sumOfSteps = 0.0;",
    ...DIRECTIONS[neighbours].map(
      (direction) => `sumOfSteps += response(v_textureCoordinates, reach * vec2(${direction}), own);`,
    ),
    `color *= exp(-u_eyeDome.x * sumOfSteps / ${neighbours.toFixed(1)});`,
  ];
}

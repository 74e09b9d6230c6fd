import type { ShaderTarget } from "../../effects/index.js";

/**
 * Eye coordinate z of a depth. The points have a frustum of their own, whatever the scene is cut into: u_depthRange is
 * its near plane n, f − n, and log2(f − n + 1) where depth is Cesium's logarithmic one (`czm_writeLogDepth`), 0 where it
 * is linear (orthographic).
 */
const EYE_Z = `
float eyeZ(float depth) {
  float beyond = u_depthRange.z > 0.0 ? exp2(depth * u_depthRange.z) - 1.0 : depth * u_depthRange.y;
  return -(u_depthRange.x + beyond);
}
`;

/**
 * Cesium's logarithmic depth d = log2(w − n + 1) / log2(f − n + 1), as `czm_writeLogDepth` writes it for each fragment, of
 * the vertex. It is handed on divided by w already, which costs no step of the depth buffer; a point needs no perspective
 * within itself. What lies before the near plane has d < 0, what lies beyond the far plane d > 1: both are clipped. Cesium
 * adds nothing to a vertex shader that calls czm_vertexLogDepth; the call also hands on what the depth-only programs read
 * that Cesium derives.
 */
const VERTEX_DEPTH = `#ifdef LOG_DEPTH
czm_vertexLogDepth();
float depth = log2(max(v_depthFromNearPlusOne, 0.5)) * czm_oneOverLog2FarDepthFromNearPlusOne;
gl_Position = gl_Position.w > 0.0
  ? vec4(gl_Position.xy / gl_Position.w, 2.0 * depth - 1.0, 1.0)
  : vec4(2.0, 2.0, 2.0, 1.0);
#endif`;

/** Cesium adds depths to the fragments of a shader that does not name that call, be it in a comment. */
const DEPTH_OF_VERTICES = "// Flat points have the depth of their vertices, without czm_writeLogDepth().";

/**
 * Cesium wraps fragment shaders that do not call czm_writeLogDepth with one that overwrites gl_FragDepth; a shader that
 * calls it is left alone (DerivedCommand.js, getLogDepthShaderProgram). Without logarithmic depth the depth is that of
 * the projection, perspective or orthographic.
 */
const WRITE_DEPTH = `
void writeDepth(float z) {
#ifdef LOG_DEPTH
  czm_writeLogDepth(1.0 - z - czm_currentFrustum.x);
#else
  gl_FragDepth = 0.5 + 0.5 * ($projection[2][2] * z + $projection[3][2]) / ($projection[2][3] * z + $projection[3][3]);
#endif
}
`;

/** The GLSL of Cesium, whose preprocessor writes the head of a file and declares its own uniforms. */
export const CESIUM: ShaderTarget = {
  header: "",
  output: "",
  words: {
    modelView: "u_modelView",
    projection: "czm_projection",
    viewport: "czm_viewport",
    pixelRatio: "czm_pixelRatio",
    onGlobe: "(u_step * stored)",
  },
  nodeTable: true,
  uniforms: [
    { name: "u_modelView", type: "mat4", scope: "node" },
    { name: "u_pickColor", type: "vec4", scope: "view" },
    { name: "u_depthRange", type: "vec3", scope: "view" },
  ],
  // Cesium's pick pass puts this colour in place of the point's.
  declarations: [DEPTH_OF_VERTICES, "uniform vec4 u_pickColor;"],
  colour: (rgba) => `czm_gammaCorrect(${rgba})`,
  vertexDepth: VERTEX_DEPTH,
  writeDepth: WRITE_DEPTH,
  eyeZ: EYE_Z,
  quad: {
    // A rectangle over the part that shows points: left, bottom, right and top.
    vertex: `in vec2 a_corner;
out vec2 v_textureCoordinates;
uniform vec4 u_coveredPart;

void main() {
  vec2 place = mix(u_coveredPart.xy, u_coveredPart.zw, a_corner);
  v_textureCoordinates = place * 0.5 + 0.5;
  gl_Position = vec4(place, 0.0, 1.0);
}
`,
    functions: [EYE_Z, WRITE_DEPTH],
    // What lies in another of the scene's frusta is drawn there.
    depth: "writeDepth(eyeZ(depth));\nif (gl_FragDepth < 0.0 || gl_FragDepth > 1.0) discard;",
  },
};

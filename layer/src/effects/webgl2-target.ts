import type { ShaderTarget } from "./declaration/shader.js";

/** Plain WebGL 2 without a library of views. */
export const WEBGL2: ShaderTarget = {
  header: "#version 300 es\nprecision highp float;\nprecision highp int;\n",
  output: "layout(location = 0) out vec4 out_FragColor;",
  words: {
    modelView: "u_modelView",
    projection: "u_projection",
    viewport: "u_viewport",
    pixelRatio: "u_pixelRatio",
    onGlobe: "(u_onGlobe * vec4(stored, 1.0)).xyz",
  },
  uniforms: [
    { name: "u_modelView", type: "mat4", scope: "node" },
    { name: "u_onGlobe", type: "mat4", scope: "node" },
    { name: "u_projection", type: "mat4", scope: "view" },
    { name: "u_viewport", type: "vec4", scope: "view" },
    { name: "u_pixelRatio", type: "float", scope: "view" },
  ],
  declarations: [],
  colour: (rgba) => rgba,
  vertexDepth: "",
  writeDepth: `
void writeDepth(float z) {
  gl_FragDepth = 0.5 + 0.5 * ($projection[2][2] * z + $projection[3][2]) / ($projection[2][3] * z + $projection[3][3]);
}
`,
  eyeZ: `
float eyeZ(float depth) {
  float clip = 2.0 * depth - 1.0;
  return ($projection[3][2] - clip * $projection[3][3]) / (clip * $projection[2][3] - $projection[2][2]);
}
`,
  quad: {
    vertex: `#version 300 es
out vec2 v_textureCoordinates;

void main() {
  v_textureCoordinates = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(2.0 * v_textureCoordinates - 1.0, 0.0, 1.0);
}
`,
    functions: [],
    depth: "gl_FragDepth = depth;",
  },
};

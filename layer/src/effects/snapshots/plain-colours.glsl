// plain colours: rgb, fixedSize

// color: vertex
in vec3 a_position;
in vec4 a_rgb;
out vec3 v_color;
uniform float u_pointSize;

void main() {
  vec4 eye = czm_modelView * vec4(a_position, 1.0);
  vec3 color = a_rgb.rgb;
  gl_Position = czm_projection * eye;
  float width = u_pointSize * czm_pixelRatio;
  gl_PointSize = width;
  #ifdef LOG_DEPTH
  czm_vertexLogDepth();
  float depth = log2(max(v_depthFromNearPlusOne, 0.5)) * czm_oneOverLog2FarDepthFromNearPlusOne;
  gl_Position = gl_Position.w > 0.0
    ? vec4(gl_Position.xy / gl_Position.w, 2.0 * depth - 1.0, 1.0)
    : vec4(2.0, 2.0, 2.0, 1.0);
  #endif
  v_color = color;
}

// color: fragment
in vec3 v_color;
// Flat points have the depth of their vertices, without czm_writeLogDepth().
uniform vec4 u_pickColor;

void main() {
  out_FragColor = czm_gammaCorrect(vec4(v_color, 1.0));
}

// id: vertex
in vec3 a_position;
flat out highp uint v_id;
uniform int u_firstId;
uniform float u_pointSize;

void main() {
  vec4 eye = czm_modelView * vec4(a_position, 1.0);
  gl_Position = czm_projection * eye;
  float width = u_pointSize * czm_pixelRatio;
  gl_PointSize = width;
  #ifdef LOG_DEPTH
  czm_vertexLogDepth();
  float depth = log2(max(v_depthFromNearPlusOne, 0.5)) * czm_oneOverLog2FarDepthFromNearPlusOne;
  gl_Position = gl_Position.w > 0.0
    ? vec4(gl_Position.xy / gl_Position.w, 2.0 * depth - 1.0, 1.0)
    : vec4(2.0, 2.0, 2.0, 1.0);
  #endif
  v_id = uint(u_firstId + gl_VertexID) + 1u;
}

// id: fragment
flat in highp uint v_id;

void main() {
  out_FragColor = vec4(uvec4(v_id, v_id >> 8u, v_id >> 16u, v_id >> 24u) & 255u) / 255.0;
}

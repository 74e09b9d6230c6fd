// plain colours: rgb, fixedSize

// color: vertex
in vec4 a_position;
in vec4 a_rgb;
out vec3 v_color;
uniform float u_pointSize;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_modelView;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

void main() {
  int ofNode = u_node * 4;
  vec4 node0 = nodeValues(ofNode + 0);
  vec4 node1 = nodeValues(ofNode + 1);
  vec4 node2 = nodeValues(ofNode + 2);
  u_modelView = transpose(mat4(node0, node1, node2, vec4(0.0, 0.0, 0.0, 1.0)));
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
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
in vec4 a_position;
flat out highp uint v_id;
uniform float u_pointSize;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_modelView;
int u_firstId;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

void main() {
  int ofNode = u_node * 4;
  vec4 node0 = nodeValues(ofNode + 0);
  vec4 node1 = nodeValues(ofNode + 1);
  vec4 node2 = nodeValues(ofNode + 2);
  vec4 node3 = nodeValues(ofNode + 3);
  u_modelView = transpose(mat4(node0, node1, node2, vec4(0.0, 0.0, 0.0, 1.0)));
  u_firstId = int(node3.x) * 65536 + int(node3.y);
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
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

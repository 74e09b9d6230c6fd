// elevation in discs with tone: gradient, tone, fixedSize, disc

// color: vertex
in vec4 a_position;
in float a_elevation;
out vec3 v_color;
uniform highp sampler2D u_gradient;
uniform vec3 u_tone;
uniform float u_pointSize;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_modelView;
vec2 u_value0;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

vec3 gradientColor(float at) {
  float place = clamp(at, 0.0, 1.0) * 255.0;
  int lower = min(int(place), 254);
  vec3 a = texelFetch(u_gradient, ivec2(lower, 0), 0).rgb;
  vec3 b = texelFetch(u_gradient, ivec2(lower + 1, 0), 0).rgb;
  return mix(a, b, place - float(lower));
}
float tone(float value) {
  return clamp((pow(value, u_tone.x) + u_tone.y - 0.5) * u_tone.z + 0.5, 0.0, 1.0);
}
vec3 tone(vec3 value) {
  return vec3(tone(value.r), tone(value.g), tone(value.b));
}
void main() {
  int ofNode = u_node * 5;
  vec4 node0 = nodeValues(ofNode + 0);
  vec4 node1 = nodeValues(ofNode + 1);
  vec4 node2 = nodeValues(ofNode + 2);
  vec4 node3 = nodeValues(ofNode + 3);
  u_modelView = transpose(mat4(node0, node1, node2, vec4(0.0, 0.0, 0.0, 1.0)));
  u_value0 = node3.zw;
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
  vec3 color = gradientColor(tone(clamp(a_elevation * u_value0.x + u_value0.y, 0.0, 1.0)));
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
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
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
  int ofNode = u_node * 5;
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
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  out_FragColor = vec4(uvec4(v_id, v_id >> 8u, v_id >> 16u, v_id >> 24u) & 255u) / 255.0;
}

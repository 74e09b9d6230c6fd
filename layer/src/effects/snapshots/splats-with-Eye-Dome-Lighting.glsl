// splats with Eye-Dome Lighting: rgb, fixedSize, splats, eyeDomeLighting

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
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  out_FragColor = vec4(v_color, 1.0);
}

// depth: vertex
in vec4 a_position;
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
}

// depth: fragment

void main() {
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  out_FragColor = vec4(1.0);
}

// splat: vertex
in vec4 a_position;
in vec4 a_rgb;
out vec3 v_color;
uniform float u_pointSize;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_modelView;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

float pixelsPerMetre(float w) {
  return 0.5 * czm_projection[1][1] * czm_viewport.w / w;
}
vec4 nearer(vec4 eye, float metres) {
  vec3 ray = czm_projection[3][3] == 0.0 ? eye.xyz / eye.z : vec3(0.0, 0.0, 1.0);
  return vec4(eye.xyz + ray * min(metres, 0.5 * abs(eye.z)), 1.0);
}
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
  float scale = pixelsPerMetre(gl_Position.w);
  float width = u_pointSize * czm_pixelRatio;
  gl_PointSize = width;
  gl_Position = czm_projection * nearer(eye, 0.5 * width / scale);
  #ifdef LOG_DEPTH
  czm_vertexLogDepth();
  float depth = log2(max(v_depthFromNearPlusOne, 0.5)) * czm_oneOverLog2FarDepthFromNearPlusOne;
  gl_Position = gl_Position.w > 0.0
    ? vec4(gl_Position.xy / gl_Position.w, 2.0 * depth - 1.0, 1.0)
    : vec4(2.0, 2.0, 2.0, 1.0);
  #endif
  v_color = color;
}

// splat: fragment
in vec3 v_color;
uniform float u_hardness;

void main() {
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  float weight = pow(1.0 - squared, u_hardness);
  out_FragColor = vec4(v_color * weight, weight);
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
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  out_FragColor = vec4(uvec4(v_id, v_id >> 8u, v_id >> 16u, v_id >> 24u) & 255u) / 255.0;
}

// edl
in vec2 v_textureCoordinates;
uniform highp sampler2D u_color;
uniform highp sampler2D u_depth;
uniform vec3 u_depthRange;
uniform vec3 u_eyeDome;

float eyeZ(float depth) {
  float beyond = u_depthRange.z > 0.0 ? exp2(depth * u_depthRange.z) - 1.0 : depth * u_depthRange.y;
  return -(u_depthRange.x + beyond);
}
void writeDepth(float z) {
#ifdef LOG_DEPTH
  czm_writeLogDepth(1.0 - z - czm_currentFrustum.x);
#else
  gl_FragDepth = 0.5 + 0.5 * (czm_projection[2][2] * z + czm_projection[3][2]) / (czm_projection[2][3] * z + czm_projection[3][3]);
#endif
}
float relief(float depth) {
  float z = -eyeZ(depth);
  return czm_projection[3][3] == 0.0 ? log2(max(z, 1e-6)) : z * czm_projection[1][1] * 0.832940;
}
float response(vec2 place, vec2 step, float own) {
  float depth = texture(u_depth, place + step).r;
  if (depth >= 1.0) return 0.0;
  return max(0.0, own - relief(depth) - u_eyeDome.z);
}
void main() {
  float depth = texture(u_depth, v_textureCoordinates).r;
  if (depth >= 1.0) discard;
  vec4 sum = texture(u_color, v_textureCoordinates);
  if (sum.a <= 0.0) discard;
  vec3 color = sum.rgb / sum.a;
  vec2 reach = u_eyeDome.y / vec2(textureSize(u_depth, 0));
  float own = relief(depth);
  float sumOfSteps = 0.0;
  sumOfSteps += response(v_textureCoordinates, reach * vec2(1.0, 0.0), own);
  sumOfSteps += response(v_textureCoordinates, reach * vec2(-1.0, 0.0), own);
  sumOfSteps += response(v_textureCoordinates, reach * vec2(0.0, 1.0), own);
  sumOfSteps += response(v_textureCoordinates, reach * vec2(0.0, -1.0), own);
  color *= exp(-u_eyeDome.x * sumOfSteps / 4.0);
  out_FragColor = czm_gammaCorrect(vec4(color, 1.0));
  writeDepth(eyeZ(depth));
  if (gl_FragDepth < 0.0 || gl_FragDepth > 1.0) discard;
}

// classes, adaptive paraboloids, filter: classification, adaptiveSize, paraboloid, filter

// color: vertex
in vec4 a_position;
in float a_classification;
in float a_returnNumber;
in float a_numberOfReturns;
in float a_intensity;
out vec3 v_color;
out vec2 v_paraboloid;
uniform highp sampler2D u_classes;
uniform highp sampler2D u_octree;
uniform vec2 u_sizeLimits;
uniform int u_returns;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_toCube;
mat4 u_modelView;
int u_octreeIndex;
vec2 u_range0;
float u_nodeSize;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

vec4 classEntry(float number) {
  return texelFetch(u_classes, ivec2(int(number + 0.5), 0), 0);
}
/* x: levels from the point's own node down to the deepest drawn one; y: log2 of that one's spacing over its level's. */
vec2 visibleLevels(vec3 place) {
  uvec3 cell = uvec3(clamp(place, 0.0, 0.99999) * 65536.0);
  int texel = u_octreeIndex;
  uvec4 node = uvec4(texelFetch(u_octree, ivec2(texel % 256, texel / 256), 0) * 255.0 + 0.5);
  int level = 0;
  while (level < 16) {
    uvec3 half3 = (cell >> uint(15 - level)) & 1u;
    uint child = half3.x | (half3.y << 1u) | (half3.z << 2u);
    if (((node.r >> child) & 1u) == 0u) break;
    uint before = node.r & ((1u << child) - 1u);
    before = before - ((before >> 1u) & 0x55u);
    before = (before & 0x33u) + ((before >> 2u) & 0x33u);
    before = (before + (before >> 4u)) & 0x0fu;
    texel += int((node.g | (node.b << 8u)) + before);
    node = uvec4(texelFetch(u_octree, ivec2(texel % 256, texel / 256), 0) * 255.0 + 0.5);
    level++;
  }
  return vec2(float(level), (float(node.a) - 128.0) / 16.0);
}
float pixelsPerMetre(float w) {
  return 0.5 * czm_projection[1][1] * czm_viewport.w / w;
}
void main() {
  int ofNode = u_node * 8;
  vec4 node0 = nodeValues(ofNode + 0);
  vec4 node1 = nodeValues(ofNode + 1);
  vec4 node2 = nodeValues(ofNode + 2);
  vec4 node3 = nodeValues(ofNode + 3);
  vec4 node4 = nodeValues(ofNode + 4);
  vec4 node5 = nodeValues(ofNode + 5);
  vec4 node6 = nodeValues(ofNode + 6);
  vec4 node7 = nodeValues(ofNode + 7);
  u_toCube = transpose(mat4(node0, node1, node2, vec4(0.0, 0.0, 0.0, 1.0)));
  u_modelView = transpose(mat4(node3, node4, node5, vec4(0.0, 0.0, 0.0, 1.0)));
  u_octreeIndex = int(node6.z) * 65536 + int(node6.w);
  u_range0 = node7.xy;
  u_nodeSize = node7.w;
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
  vec2 visible = visibleLevels((u_toCube * vec4(stored, 1.0)).xyz);
  bool isFirst = a_returnNumber < 1.5;
  bool isLast = a_returnNumber > a_numberOfReturns - 0.5;
  int returnKind = isFirst ? (isLast ? 11 : 1) : (isLast ? 2 : 4);
  if ((returnKind & u_returns) == 0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  if (a_intensity < u_range0.x || a_intensity > u_range0.y) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  vec3 color = classEntry(a_classification).rgb;
  gl_Position = czm_projection * eye;
  float scale = pixelsPerMetre(gl_Position.w);
  float width = u_nodeSize * exp2(visible.y - visible.x) * scale;
  width = clamp(width, u_sizeLimits.x * czm_pixelRatio, u_sizeLimits.y * czm_pixelRatio);
  gl_PointSize = width;
  #ifdef LOG_DEPTH
  czm_vertexLogDepth();
  float depth = log2(max(v_depthFromNearPlusOne, 0.5)) * czm_oneOverLog2FarDepthFromNearPlusOne;
  gl_Position = gl_Position.w > 0.0
    ? vec4(gl_Position.xy / gl_Position.w, 2.0 * depth - 1.0, 1.0)
    : vec4(2.0, 2.0, 2.0, 1.0);
  #endif
  v_color = color;
  v_paraboloid = vec2(eye.z, 0.5 * width / scale);
}

// color: fragment
in vec3 v_color;
in vec2 v_paraboloid;
// Flat points have the depth of their vertices, without czm_writeLogDepth().
uniform vec4 u_pickColor;

void writeDepth(float z) {
#ifdef LOG_DEPTH
  czm_writeLogDepth(1.0 - z - czm_currentFrustum.x);
#else
  gl_FragDepth = 0.5 + 0.5 * (czm_projection[2][2] * z + czm_projection[3][2]) / (czm_projection[2][3] * z + czm_projection[3][3]);
#endif
}
void main() {
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  out_FragColor = czm_gammaCorrect(vec4(v_color, 1.0));
  writeDepth(v_paraboloid.x - v_paraboloid.y * squared);
}

// id: vertex
in vec4 a_position;
in float a_returnNumber;
in float a_numberOfReturns;
in float a_intensity;
flat out highp uint v_id;
out vec2 v_paraboloid;
uniform highp sampler2D u_octree;
uniform vec2 u_sizeLimits;
uniform int u_returns;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_toCube;
mat4 u_modelView;
int u_firstId;
int u_octreeIndex;
vec2 u_range0;
float u_nodeSize;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

/* x: levels from the point's own node down to the deepest drawn one; y: log2 of that one's spacing over its level's. */
vec2 visibleLevels(vec3 place) {
  uvec3 cell = uvec3(clamp(place, 0.0, 0.99999) * 65536.0);
  int texel = u_octreeIndex;
  uvec4 node = uvec4(texelFetch(u_octree, ivec2(texel % 256, texel / 256), 0) * 255.0 + 0.5);
  int level = 0;
  while (level < 16) {
    uvec3 half3 = (cell >> uint(15 - level)) & 1u;
    uint child = half3.x | (half3.y << 1u) | (half3.z << 2u);
    if (((node.r >> child) & 1u) == 0u) break;
    uint before = node.r & ((1u << child) - 1u);
    before = before - ((before >> 1u) & 0x55u);
    before = (before & 0x33u) + ((before >> 2u) & 0x33u);
    before = (before + (before >> 4u)) & 0x0fu;
    texel += int((node.g | (node.b << 8u)) + before);
    node = uvec4(texelFetch(u_octree, ivec2(texel % 256, texel / 256), 0) * 255.0 + 0.5);
    level++;
  }
  return vec2(float(level), (float(node.a) - 128.0) / 16.0);
}
float pixelsPerMetre(float w) {
  return 0.5 * czm_projection[1][1] * czm_viewport.w / w;
}
void main() {
  int ofNode = u_node * 8;
  vec4 node0 = nodeValues(ofNode + 0);
  vec4 node1 = nodeValues(ofNode + 1);
  vec4 node2 = nodeValues(ofNode + 2);
  vec4 node3 = nodeValues(ofNode + 3);
  vec4 node4 = nodeValues(ofNode + 4);
  vec4 node5 = nodeValues(ofNode + 5);
  vec4 node6 = nodeValues(ofNode + 6);
  vec4 node7 = nodeValues(ofNode + 7);
  u_toCube = transpose(mat4(node0, node1, node2, vec4(0.0, 0.0, 0.0, 1.0)));
  u_modelView = transpose(mat4(node3, node4, node5, vec4(0.0, 0.0, 0.0, 1.0)));
  u_firstId = int(node6.x) * 65536 + int(node6.y);
  u_octreeIndex = int(node6.z) * 65536 + int(node6.w);
  u_range0 = node7.xy;
  u_nodeSize = node7.w;
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
  vec2 visible = visibleLevels((u_toCube * vec4(stored, 1.0)).xyz);
  bool isFirst = a_returnNumber < 1.5;
  bool isLast = a_returnNumber > a_numberOfReturns - 0.5;
  int returnKind = isFirst ? (isLast ? 11 : 1) : (isLast ? 2 : 4);
  if ((returnKind & u_returns) == 0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  if (a_intensity < u_range0.x || a_intensity > u_range0.y) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  gl_Position = czm_projection * eye;
  float scale = pixelsPerMetre(gl_Position.w);
  float width = u_nodeSize * exp2(visible.y - visible.x) * scale;
  width = clamp(width, u_sizeLimits.x * czm_pixelRatio, u_sizeLimits.y * czm_pixelRatio);
  gl_PointSize = width;
  #ifdef LOG_DEPTH
  czm_vertexLogDepth();
  float depth = log2(max(v_depthFromNearPlusOne, 0.5)) * czm_oneOverLog2FarDepthFromNearPlusOne;
  gl_Position = gl_Position.w > 0.0
    ? vec4(gl_Position.xy / gl_Position.w, 2.0 * depth - 1.0, 1.0)
    : vec4(2.0, 2.0, 2.0, 1.0);
  #endif
  v_id = uint(u_firstId + gl_VertexID) + 1u;
  v_paraboloid = vec2(eye.z, 0.5 * width / scale);
}

// id: fragment
flat in highp uint v_id;
in vec2 v_paraboloid;

void writeDepth(float z) {
#ifdef LOG_DEPTH
  czm_writeLogDepth(1.0 - z - czm_currentFrustum.x);
#else
  gl_FragDepth = 0.5 + 0.5 * (czm_projection[2][2] * z + czm_projection[3][2]) / (czm_projection[2][3] * z + czm_projection[3][3]);
#endif
}
void main() {
  vec2 offset = 2.0 * gl_PointCoord - 1.0;
  float squared = dot(offset, offset);
  if (squared > 1.0) discard;
  out_FragColor = vec4(uvec4(v_id, v_id >> 8u, v_id >> 16u, v_id >> 24u) & 255u) / 255.0;
  writeDepth(v_paraboloid.x - v_paraboloid.y * squared);
}

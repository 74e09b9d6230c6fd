// clips and highlight, levels blended with intensity: gradient, levelOfDetail, blend, fixedSize, opacity, clip, highlight

// color: vertex
in vec4 a_position;
in float a_intensity;
out vec3 v_color;
uniform highp sampler2D u_gradient;
uniform highp sampler2D u_octree;
uniform vec2 u_levels;
uniform float u_blend;
uniform float u_pointSize;
uniform highp sampler2D u_clips;
uniform vec4 u_highlight;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_toCube;
mat4 u_modelView;
vec2 u_value1;
int u_octreeIndex;
vec2 u_clipRecords;
float u_step;
float u_nodeLevel;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

vec3 gradientColor(float at) {
  float place = clamp(at, 0.0, 1.0) * 255.0;
  int lower = min(int(place), 254);
  vec3 a = texelFetch(u_gradient, ivec2(lower, 0), 0).rgb;
  vec3 b = texelFetch(u_gradient, ivec2(lower + 1, 0), 0).rgb;
  return mix(a, b, place - float(lower));
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
vec4 clipTexel(int index) {
  return texelFetch(u_clips, ivec2(index % 256, index / 256), 0);
}
bool insidePlanes(int from, int count, vec3 p) {
  for (int i = 0; i < count; i++) {
    vec4 plane = clipTexel(from + i);
    if (dot(plane.xyz, p) + plane.w < 0.0) return false;
  }
  return true;
}
bool insidePrism(int from, int edges, int bits, vec3 p) {
  vec4 radii = clipTexel(from);
  vec4 heights = clipTexel(from + 1);
  if ((bits & 6) != 0) {
    vec4 slopes = clipTexel(from + 2);
    float across = dot(p.xy * p.xy, radii.xy);
    float along = 1.0 + p.z * heights.w;
    float height = p.z + across / (along + sqrt(along * along + across * heights.w));
    if ((bits & 2) != 0 && height < heights.y + dot(slopes.xy, p.xy)) return false;
    if ((bits & 4) != 0 && height > heights.z + dot(slopes.zw, p.xy)) return false;
  }
  vec2 shrink = p.z * radii.xy;
  vec2 q = p.xy - p.xy * (shrink / (1.0 + shrink)) - (p.z - heights.x) * radii.zw;
  bool inside = (bits & 1) != 0;
  for (int i = 0; i < edges; i++) {
    vec4 edge = clipTexel(from + 3 + i);
    if ((edge.y > q.y) == (edge.w > q.y)) continue;
    vec2 along = edge.zw - edge.xy;
    float side = (q.x - edge.x) * along.y - (q.y - edge.y) * along.x;
    if ((side > 0.0) == (along.y > 0.0)) inside = !inside;
  }
  return inside;
}
/* Numbers of records: that keep what is inside; of these, around the point; that cut, around it; that highlight, around it. */
ivec4 clipRoles(vec3 p) {
  ivec4 counts = ivec4(0);
  int at = int(u_clipRecords.x);
  int records = int(u_clipRecords.y);
  for (int record = 0; record < records; record++) {
    vec4 head = clipTexel(at++);
    int count = int(head.z);
    bool prism = head.x > 0.5;
    bool inside = prism ? insidePrism(at, count, int(head.w), p) : insidePlanes(at, count, p);
    at += count + (prism ? 3 : 0);
    if (head.y < 0.5) {
      counts.x++;
      if (inside) counts.y++;
    } else if (inside) {
      if (head.y < 1.5) counts.z++;
      else counts.w++;
    }
  }
  return counts;
}
void main() {
  int ofNode = u_node * 9;
  vec4 node0 = nodeValues(ofNode + 0);
  vec4 node1 = nodeValues(ofNode + 1);
  vec4 node2 = nodeValues(ofNode + 2);
  vec4 node3 = nodeValues(ofNode + 3);
  vec4 node4 = nodeValues(ofNode + 4);
  vec4 node5 = nodeValues(ofNode + 5);
  vec4 node6 = nodeValues(ofNode + 6);
  vec4 node7 = nodeValues(ofNode + 7);
  vec4 node8 = nodeValues(ofNode + 8);
  u_toCube = transpose(mat4(node0, node1, node2, vec4(0.0, 0.0, 0.0, 1.0)));
  u_modelView = transpose(mat4(node3, node4, node5, vec4(0.0, 0.0, 0.0, 1.0)));
  u_value1 = node6.zw;
  u_octreeIndex = int(node7.x) * 65536 + int(node7.y);
  u_clipRecords = node7.zw;
  u_step = node8.x;
  u_nodeLevel = node8.y;
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
  vec2 visible = visibleLevels((u_toCube * vec4(stored, 1.0)).xyz);
  ivec4 roles = clipRoles((u_step * stored));
  if (roles.z > 0 || (roles.x > 0 && roles.y == 0)) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
  vec3 color1 = gradientColor(a_intensity * u_value1.x + u_value1.y);
  vec3 color0 = gradientColor((u_nodeLevel + visible.x) * u_levels.x + u_levels.y);
  vec3 color = mix(color0, color1, u_blend);
  if (roles.w > 0) color = mix(color, u_highlight.rgb, u_highlight.a);
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
  out_FragColor = vec4(v_color, 1.0);
}

// id: vertex
in vec4 a_position;
flat out highp uint v_id;
uniform float u_pointSize;
uniform highp sampler2D u_clips;
uniform highp sampler2D u_nodes;
uniform int u_node;
mat4 u_modelView;
int u_firstId;
vec2 u_clipRecords;
float u_step;
vec4 nodeValues(int texel) { return texelFetch(u_nodes, ivec2(texel % 256, texel / 256), 0); }

vec4 clipTexel(int index) {
  return texelFetch(u_clips, ivec2(index % 256, index / 256), 0);
}
bool insidePlanes(int from, int count, vec3 p) {
  for (int i = 0; i < count; i++) {
    vec4 plane = clipTexel(from + i);
    if (dot(plane.xyz, p) + plane.w < 0.0) return false;
  }
  return true;
}
bool insidePrism(int from, int edges, int bits, vec3 p) {
  vec4 radii = clipTexel(from);
  vec4 heights = clipTexel(from + 1);
  if ((bits & 6) != 0) {
    vec4 slopes = clipTexel(from + 2);
    float across = dot(p.xy * p.xy, radii.xy);
    float along = 1.0 + p.z * heights.w;
    float height = p.z + across / (along + sqrt(along * along + across * heights.w));
    if ((bits & 2) != 0 && height < heights.y + dot(slopes.xy, p.xy)) return false;
    if ((bits & 4) != 0 && height > heights.z + dot(slopes.zw, p.xy)) return false;
  }
  vec2 shrink = p.z * radii.xy;
  vec2 q = p.xy - p.xy * (shrink / (1.0 + shrink)) - (p.z - heights.x) * radii.zw;
  bool inside = (bits & 1) != 0;
  for (int i = 0; i < edges; i++) {
    vec4 edge = clipTexel(from + 3 + i);
    if ((edge.y > q.y) == (edge.w > q.y)) continue;
    vec2 along = edge.zw - edge.xy;
    float side = (q.x - edge.x) * along.y - (q.y - edge.y) * along.x;
    if ((side > 0.0) == (along.y > 0.0)) inside = !inside;
  }
  return inside;
}
/* Numbers of records: that keep what is inside; of these, around the point; that cut, around it; that highlight, around it. */
ivec4 clipRoles(vec3 p) {
  ivec4 counts = ivec4(0);
  int at = int(u_clipRecords.x);
  int records = int(u_clipRecords.y);
  for (int record = 0; record < records; record++) {
    vec4 head = clipTexel(at++);
    int count = int(head.z);
    bool prism = head.x > 0.5;
    bool inside = prism ? insidePrism(at, count, int(head.w), p) : insidePlanes(at, count, p);
    at += count + (prism ? 3 : 0);
    if (head.y < 0.5) {
      counts.x++;
      if (inside) counts.y++;
    } else if (inside) {
      if (head.y < 1.5) counts.z++;
      else counts.w++;
    }
  }
  return counts;
}
void main() {
  int ofNode = u_node * 9;
  vec4 node3 = nodeValues(ofNode + 3);
  vec4 node4 = nodeValues(ofNode + 4);
  vec4 node5 = nodeValues(ofNode + 5);
  vec4 node6 = nodeValues(ofNode + 6);
  vec4 node7 = nodeValues(ofNode + 7);
  vec4 node8 = nodeValues(ofNode + 8);
  u_modelView = transpose(mat4(node3, node4, node5, vec4(0.0, 0.0, 0.0, 1.0)));
  u_firstId = int(node6.x) * 65536 + int(node6.y);
  u_clipRecords = node7.zw;
  u_step = node8.x;
  vec3 stored = a_position.xyz + 65536.0 * vec3((ivec3(int(a_position.w)) << ivec3(26, 21, 16)) >> 27);
  vec4 eye = u_modelView * vec4(stored, 1.0);
  ivec4 roles = clipRoles((u_step * stored));
  if (roles.z > 0 || (roles.x > 0 && roles.y == 0)) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    return;
  }
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

// splatNormalise
in vec2 v_textureCoordinates;
uniform highp sampler2D u_color;
uniform highp sampler2D u_depth;
uniform vec3 u_depthRange;
uniform float u_opacity;

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
void main() {
  float depth = texture(u_depth, v_textureCoordinates).r;
  if (depth >= 1.0) discard;
  vec4 sum = texture(u_color, v_textureCoordinates);
  vec3 color = sum.rgb;
  out_FragColor = czm_gammaCorrect(vec4(color, 1.0));
  out_FragColor.a *= u_opacity;
  writeDepth(eyeZ(depth));
  if (gl_FragDepth < 0.0 || gl_FragDepth > 1.0) discard;
}

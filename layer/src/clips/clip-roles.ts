/** Texels in a row of the texture of clips. */
export const CLIP_WIDTH = 256;

/** Kinds of records. */
export const PLANES = 0;
export const PRISM = 1;

/** Texels of a prism before its edges. */
export const PRISM_HEADER = 4;

/** What a volume is for: points inside are the ones that stay, are cut, or stand out. */
export const ROLES = { inside: 0, outside: 1, highlight: 2 } as const;

/** Bits of a prism: whether the corner that rays start from is inside; whether it has a bottom and a top. */
export const STARTS_INSIDE = 1;
export const HAS_BOTTOM = 2;
export const HAS_TOP = 4;

/**
 * What a point is to the volumes of its node. Their records stand in texels of four floats, metres in the node's frame:
 *
 * - planes: (0, role, number, –), then each as (n, d): inside is where n · p + d ≥ 0 for all of them;
 * - prism: (1, role, edges, bits), (1 / N, 1 / M, tilt), (z of the tilt, bottom, top, 1 / R), (slopes of bottom, of top), then
 *   each edge as (a, b). The point is moved along the vertical to the plane of the edges, where a ray to the west and
 *   then the box's western side to its south-western corner count the edges on the way.
 */
export const CLIP_ROLES = `
vec4 clipTexel(int index) {
  return texelFetch(u_clips, ivec2(index % ${CLIP_WIDTH}, index / ${CLIP_WIDTH}), 0);
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
  if ((bits & ${HAS_BOTTOM | HAS_TOP}) != 0) {
    vec4 slopes = clipTexel(from + 2);
    float across = dot(p.xy * p.xy, radii.xy);
    float along = 1.0 + p.z * heights.w;
    float height = p.z + across / (along + sqrt(along * along + across * heights.w));
    if ((bits & ${HAS_BOTTOM}) != 0 && height < heights.y + dot(slopes.xy, p.xy)) return false;
    if ((bits & ${HAS_TOP}) != 0 && height > heights.z + dot(slopes.zw, p.xy)) return false;
  }
  vec2 shrink = p.z * radii.xy;
  vec2 q = p.xy - p.xy * (shrink / (1.0 + shrink)) - (p.z - heights.x) * radii.zw;
  bool inside = (bits & ${STARTS_INSIDE}) != 0;
  for (int i = 0; i < edges; i++) {
    vec4 edge = clipTexel(from + ${PRISM_HEADER - 1} + i);
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
    at += count + (prism ? ${PRISM_HEADER - 1} : 0);
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
`;

/** An eye position moved towards the camera, along the ray through it, by metres of depth. */
export const NEARER = `
vec4 nearer(vec4 eye, float metres) {
  vec3 ray = $projection[3][3] == 0.0 ? eye.xyz / eye.z : vec3(0.0, 0.0, 1.0);
  return vec4(eye.xyz + ray * min(metres, 0.5 * abs(eye.z)), 1.0);
}
`;

/** Texels of the texture of a gradient. */
export const GRADIENT_WIDTH = 256;

/** Colour of a gradient's texture at a place from 0 to 1. */
export const GRADIENT = `
vec3 gradientColor(float at) {
  float place = clamp(at, 0.0, 1.0) * ${(GRADIENT_WIDTH - 1).toFixed(1)};
  int lower = min(int(place), ${GRADIENT_WIDTH - 2});
  vec3 a = texelFetch(u_gradient, ivec2(lower, 0), 0).rgb;
  vec3 b = texelFetch(u_gradient, ivec2(lower + 1, 0), 0).rgb;
  return mix(a, b, place - float(lower));
}
`;

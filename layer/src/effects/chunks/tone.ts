/** Gamma, brightness and contrast: u_tone is the exponent, the summand and the slope around the middle. */
export const TONE = `
float tone(float value) {
  return clamp((pow(value, u_tone.x) + u_tone.y - 0.5) * u_tone.z + 0.5, 0.0, 1.0);
}
vec3 tone(vec3 value) {
  return vec3(tone(value.r), tone(value.g), tone(value.b));
}
`;

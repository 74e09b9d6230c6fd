/** Colour of a class, and in alpha whether it is shown. */
export const CLASS_ENTRY = `
vec4 classEntry(float number) {
  return texelFetch(u_classes, ivec2(int(number + 0.5), 0), 0);
}
`;

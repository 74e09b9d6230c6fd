/**
 * Writes the depth of an eye coordinate z. Cesium wraps fragment shaders that do not call czm_writeLogDepth with one that
 * overwrites gl_FragDepth; a shader that calls it is left alone (DerivedCommand.js, getLogDepthShaderProgram). Without
 * logarithmic depth the depth is that of the projection, perspective or orthographic.
 */
export const FRAGMENT_DEPTH = {
  cesium: `
void writeDepth(float z) {
#ifdef LOG_DEPTH
  czm_writeLogDepth(1.0 - z - czm_currentFrustum.x);
#else
  gl_FragDepth = 0.5 + 0.5 * ($projection[2][2] * z + $projection[3][2]) / ($projection[2][3] * z + $projection[3][3]);
#endif
}
`,
  webgl2: `
void writeDepth(float z) {
  gl_FragDepth = 0.5 + 0.5 * ($projection[2][2] * z + $projection[3][2]) / ($projection[2][3] * z + $projection[3][3]);
}
`,
} as const;

/** Statement that leaves a point out: outside the clip volume nothing of it is drawn. */
export function rejectIf(condition: string): string {
  return `if (${condition}) {\n  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);\n  gl_PointSize = 1.0;\n  return;\n}`;
}

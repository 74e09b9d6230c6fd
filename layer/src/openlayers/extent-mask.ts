import type { PointShader } from "../effects/index.js";
import type { GlObjects } from "../webgl2/gl-objects.js";
import type { GlProgram } from "../webgl2/gl-program.js";
import { GlUniforms } from "../webgl2/gl-uniforms.js";
import { drawQuad, type PassTarget } from "../webgl2/point-passes.js";

/** Corners of an extent in CSS pixels from the upper left of the map, in order. */
export type Corners = readonly (readonly number[])[];

const SHADER: PointShader = {
  vertex: `#version 300 es
void main() {
  gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, -1.0, 1.0);
}
`,
  fragment: `#version 300 es
precision highp float;
uniform mat4 u_sides;
out vec4 out_FragColor;
void main() {
  vec4 inside = vec4(gl_FragCoord.xy, 1.0, 0.0) * u_sides;
  if (all(greaterThanEqual(inside, vec4(0.0)))) discard;
  out_FragColor = vec4(0.0);
}
`,
  attributes: [],
  uniforms: [{ name: "u_sides", type: "mat4", scope: "view" }],
};

/**
 * Takes out of the canvas what lies beyond a layer's extent. In the canvas and not by a style of it, so that it is not there
 * either where an application copies the canvases of a map for a print.
 */
export class ExtentMask {
  readonly #gl: WebGL2RenderingContext;
  readonly #program: GlProgram;
  readonly #values = new GlUniforms();

  constructor(objects: GlObjects) {
    this.#gl = objects.gl;
    this.#program = objects.program(SHADER);
  }

  draw(target: PassTarget, corners: Corners, pixelRatio: number): void {
    this.#values.set({ u_sides: sidesOf(corners, pixelRatio, target.viewport[3]) });
    this.#program.use(this.#values);
    drawQuad(this.#gl, target);
  }
}

/**
 * The four sides as half-planes, column-major: a x + b y + c ≥ 0 within, x and y pixels of the canvas from the lower left.
 * @param height of the canvas, pixels
 */
export function sidesOf(corners: Corners, pixelRatio: number, height: number): number[] {
  const places = corners.map(([x, y]) => [x * pixelRatio, height - y * pixelRatio] as const);
  const planes = places.map(([x, y], side) => {
    const [toX, toY] = places[(side + 1) % places.length];
    return [y - toY, toX - x, x * toY - toX * y] as const;
  });
  // Whichever way round the corners go, the middle is within.
  const middle = [0, 1].map((axis) => places.reduce((sum, at) => sum + at[axis], 0) / places.length);
  return planes.flatMap(([a, b, c]) => {
    const sign = Math.sign(a * middle[0] + b * middle[1] + c);
    return [sign * a, sign * b, sign * c, 0];
  });
}

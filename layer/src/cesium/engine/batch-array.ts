import type { Context, VertexArray } from "./cesium-private.js";

/** One draw of a batch. */
interface Draw {
  readonly array: VertexArray;
  /** What the program is told of it. */
  readonly number: number;
  /** Vertices, from the first one on. */
  readonly count: number;
}

/**
 * Many vertex arrays that Cesium takes for one: whenever it binds it to draw a command, or one derived from it, all of them
 * are drawn, with the program and the uniforms that the command has set. What Cesium then draws itself has no vertices.
 */
export class BatchArray implements VertexArray {
  readonly indexBuffer = undefined;
  readonly numberOfVertices = 0;
  readonly #context: Context;
  /** Name of the integer uniform that says which draw it is. */
  readonly #uniform: string;
  readonly #locations = new WeakMap<WebGLProgram, WebGLUniformLocation>();
  #draws: readonly Draw[] = [];

  constructor(context: Context, uniform: string) {
    this.#context = context;
    this.#uniform = uniform;
  }

  /** What is drawn from now on. */
  set draws(draws: readonly Draw[]) {
    this.#draws = draws;
  }

  _bind(): void {
    const { _gl: gl } = this.#context;
    const location = this.#location(gl);
    for (const { array, number, count } of this.#draws) {
      array._bind();
      gl.uniform1i(location, number);
      gl.drawArrays(gl.POINTS, 0, count);
    }
  }

  _unBind(): void {
    this.#draws.at(-1)?.array._unBind();
  }

  /** The arrays are others'. */
  destroy(): void {
    this.#draws = [];
  }

  #location(gl: WebGL2RenderingContext): WebGLUniformLocation | null {
    const program: WebGLProgram | null = gl.getParameter(gl.CURRENT_PROGRAM);
    if (!program) return null;
    const known = this.#locations.get(program);
    if (known) return known;
    const location = gl.getUniformLocation(program, this.#uniform);
    if (location) this.#locations.set(program, location);
    return location;
  }
}

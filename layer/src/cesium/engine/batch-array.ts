import { DrawList } from "../../drawing/draw-list.js";
import type { PointDraws } from "../../drawing/point-draws.js";
import type { Context, VertexArray } from "./cesium-private.js";

/**
 * A list of draws that Cesium takes for one vertex array: whenever it binds it to draw a command, or one derived from it, all
 * of them are drawn, with the program and the uniforms that the command has set. What Cesium then draws itself has no vertices.
 */
export class BatchArray implements VertexArray {
  readonly indexBuffer = undefined;
  readonly numberOfVertices = 0;
  /** What is drawn. */
  readonly list = new DrawList<VertexArray>();
  readonly #context: Context;
  readonly #draws: PointDraws;
  /** Name of the integer uniform that says which node is drawn. */
  readonly #uniform: string;
  readonly #locations = new WeakMap<WebGLProgram, WebGLUniformLocation>();

  constructor(context: Context, draws: PointDraws, uniform: string) {
    this.#context = context;
    this.#draws = draws;
    this.#uniform = uniform;
  }

  _bind(): void {
    const { _gl: gl } = this.#context;
    const location = this.#location(gl);
    const bind = (array: VertexArray) => array._bind();
    this.#draws.draw(this.list, { bind, number: (row) => gl.uniform1i(location, row) });
  }

  _unBind(): void {
    const { runs } = this.list;
    if (runs > 0) this.list.run(runs - 1).array._unBind();
  }

  /** The arrays are others'. */
  destroy(): void {
    this.list.clear();
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

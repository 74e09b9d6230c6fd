import type { DrawList } from "./draw-list.js";

/** `WEBGL_multi_draw`, as far as it is used. */
interface MultiDraw {
  multiDrawArraysWEBGL(
    mode: number,
    firsts: Int32Array,
    firstsOffset: number,
    counts: Int32Array,
    countsOffset: number,
    draws: number,
  ): void;
}

const MULTI_DRAW = "WEBGL_multi_draw";

/** How a program in use is told what is drawn. */
export interface DrawBinding<VertexArray> {
  bind(array: VertexArray): void;
  /** Sets the uniform `NODE_NUMBER`. */
  number(row: number): void;
}

/** Draws lists of nodes in one context of WebGL 2: many nodes in a call where the browser has `WEBGL_multi_draw`. */
export class PointDraws {
  /** Whether one call draws many; programs are to be made for that (`ShaderTarget.manyDraws`). */
  readonly many: boolean;
  readonly #gl: WebGL2RenderingContext;
  #multi: MultiDraw | undefined;

  constructor(gl: WebGL2RenderingContext) {
    this.#gl = gl;
    this.many = gl.getSupportedExtensions()?.includes(MULTI_DRAW) ?? false;
  }

  /**
   * Turns on that one call draws many, without which no program for that compiles. A browser waits for the graphics card then,
   * as it does for the compiler: called right before that it waits once.
   */
  enable(): void {
    if (this.many) this.#multi ??= (this.#gl.getExtension(MULTI_DRAW) as MultiDraw | null) ?? undefined;
  }

  /** @param from row of the table that the rows of the list count from */
  draw<VertexArray>(list: DrawList<VertexArray>, binding: DrawBinding<VertexArray>, from = 0): void {
    const gl = this.#gl;
    const { firsts, counts } = list;
    for (let index = 0; index < list.runs; index++) {
      const { array, row, begin, end } = list.run(index);
      binding.bind(array);
      if (this.#multi) {
        binding.number(from + row);
        this.#multi.multiDrawArraysWEBGL(gl.POINTS, firsts, begin, counts, begin, end - begin);
        continue;
      }
      for (let at = begin; at < end; at++) {
        binding.number(from + row + at - begin);
        gl.drawArrays(gl.POINTS, firsts[at], counts[at]);
      }
    }
  }
}

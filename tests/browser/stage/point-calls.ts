/** A call of WebGL that draws points, one run of vertices or many. */
export interface PointCall {
  /** Vertices of each run. */
  readonly counts: readonly number[];
  /** Makes the call; with no vertices where points are not to be rasterised. */
  draw(vertices?: "none"): void;
}

const MANY = "WEBGL_multi_draw";

/** `WEBGL_multi_draw`, as the layers use it. */
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

/**
 * Does something in place of each call that draws points.
 * @param gl a context, or what all have in common
 * @returns lets the calls be as they were
 */
export function onPoints(gl: WebGL2RenderingContext, instead: (call: PointCall) => void): () => void {
  const { drawArrays, getExtension } = gl;
  const undo: (() => void)[] = [];
  gl.drawArrays = function (mode, first, count) {
    if (mode !== this.POINTS) return drawArrays.call(this, mode, first, count);
    instead({
      counts: [count],
      draw: (vertices) => drawArrays.call(this, mode, first, vertices === "none" ? 0 : count),
    });
  };
  undo.push(() => {
    gl.drawArrays = drawArrays;
  });
  /** Counts of no vertices. */
  let none = new Int32Array(0);
  const watched = new Set<MultiDraw>();
  const watch = (extension: MultiDraw | null) => {
    if (!extension || watched.has(extension)) return;
    watched.add(extension);
    const own = extension.multiDrawArraysWEBGL;
    extension.multiDrawArraysWEBGL = function (mode, firsts, firstsAt, counts, countsAt, draws) {
      if (none.length < counts.length) none = new Int32Array(counts.length);
      instead({
        get counts() {
          return [...counts.subarray(countsAt, countsAt + draws)];
        },
        draw: (vertices) => {
          const shown = vertices === "none" ? none : counts;
          own.call(this, mode, firsts, firstsAt, shown, countsAt, draws);
        },
      });
    };
    undo.push(() => {
      extension.multiDrawArraysWEBGL = own;
    });
  };
  gl.getExtension = function (this: WebGL2RenderingContext, name: string) {
    const extension = getExtension.call(this, name as typeof MANY);
    if (name === MANY) watch(extension as MultiDraw | null);
    return extension;
  } as typeof getExtension;
  undo.push(() => {
    gl.getExtension = getExtension;
  });
  // One that was asked for before is the same object.
  if (gl !== WebGL2RenderingContext.prototype) gl.getExtension(MANY);
  return () => {
    for (const step of undo) step();
  };
}

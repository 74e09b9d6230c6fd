import type { PointCloud } from "../cloud/index.js";
import type { PlotView } from "../tools/plot/plot-view.js";
import { contextOf } from "../webgl2/context.js";
import { clear } from "../webgl2/point-passes.js";
import { plotCamera } from "./plot-camera.js";
import { type PlotDrawing, PlotSeries } from "./plot-series.js";

/**
 * The points of profiles in a canvas, chainage against height, by the shaders that layers are drawn with: a point looks as on
 * globe and map. What is on the GPU stays there: to pan and zoom is to set uniforms, and a node that comes is drawn over what
 * is there already.
 */
export class PlotPicture {
  readonly #canvas: HTMLCanvasElement;
  readonly #changed: () => void;
  readonly #series = new Set<PlotSeries>();
  readonly #gl: WebGL2RenderingContext;

  /**
   * @param canvas as large as the plot itself, axes outside of it
   * @param changed told that {@link draw} is to be called; wait for the next frame of the browser
   * @throws DrawError DRAW_WEBGL2 where the browser has no WebGL 2
   */
  constructor(canvas: HTMLCanvasElement, changed: () => void) {
    this.#canvas = canvas;
    this.#changed = changed;
    this.#gl = contextOf(canvas, "plot");
    canvas.addEventListener("webglcontextlost", this.#onLost);
    canvas.addEventListener("webglcontextrestored", changed);
  }

  /** Adds the points of a cloud, none yet; those of series added later are drawn over them where they are as near to the line. */
  addSeries(cloud: PointCloud, drawing: PlotDrawing): PlotSeries {
    const series = new PlotSeries(cloud, drawing, this.#changed);
    this.#series.add(series);
    return series;
  }

  /** Takes away a series, and frees what it takes. */
  remove(series: PlotSeries): void {
    if (!this.#series.delete(series)) return;
    series.release(false);
    for (const other of this.#series) other.forget();
    this.#changed();
  }

  /**
   * Draws what a view sees, as far as a frame may prepare it: some megabytes and milliseconds.
   * @param pixelRatio pixels of the canvas per pixel of the view. Default: the screen's
   * @returns whether it is whole; else it is to be called again in the next frame
   * @throws DrawError DRAW_PROGRAM
   */
  draw(view: PlotView, pixelRatio = devicePixelRatio): boolean {
    const gl = this.#gl;
    if (gl.isContextLost()) return true;
    const all = [...this.#series];
    const reach = Math.max(0, ...all.map((series) => series.reach));
    const camera = plotCamera(view, reach, pixelRatio);
    const resized = this.#canvas.width !== camera.width || this.#canvas.height !== camera.height;
    if (resized) [this.#canvas.width, this.#canvas.height] = [camera.width, camera.height];
    let waiting = 0;
    for (const series of all) waiting += series.prepare(gl, view, camera);
    const anew = resized || all.length === 0 || all.some(({ kept }) => kept < 0);
    const overlaid = all.some(({ offscreen }) => offscreen);
    if (anew || overlaid)
      clear(gl, { framebuffer: undefined, viewport: [0, 0, camera.width, camera.height] });
    for (const series of all) series.draw(anew || (overlaid && !series.offscreen) ? 0 : series.kept);
    return waiting === 0;
  }

  /** Frees all. */
  destroy(): void {
    this.#canvas.removeEventListener("webglcontextlost", this.#onLost);
    this.#canvas.removeEventListener("webglcontextrestored", this.#changed);
    for (const series of this.#series) series.release(false);
    this.#series.clear();
    this.#gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  readonly #onLost = (event: Event): void => {
    // Else the browser would not give it back.
    event.preventDefault();
    for (const series of this.#series) series.release(true);
  };
}

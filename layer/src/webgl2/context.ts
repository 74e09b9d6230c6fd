import { DrawError } from "../errors/index.js";

/** What was drawn stays until something else is drawn; colours are as they are, whatever the opacity. */
const OPTIONS: WebGLContextAttributes = {
  alpha: true,
  antialias: false,
  depth: true,
  stencil: false,
  premultipliedAlpha: false,
  preserveDrawingBuffer: true,
};

/**
 * The WebGL 2 context of a canvas.
 * @param file what errors call the picture
 * @throws DrawError DRAW_WEBGL2 where the browser has no WebGL 2
 */
export function contextOf(canvas: HTMLCanvasElement, file: string): WebGL2RenderingContext {
  const gl = canvas.getContext("webgl2", OPTIONS);
  if (gl) return gl;
  throw new DrawError({
    code: "DRAW_WEBGL2",
    file,
    cause: "the browser gives no WebGL 2 context",
    fix: "Use a browser with WebGL 2, and see that hardware acceleration is on",
  });
}

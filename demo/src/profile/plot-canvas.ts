import type { PlotView, ProfilePoints } from "@groma/layer/tools";

const VERTEX = `#version 300 es
layout(location = 0) in vec2 place;
layout(location = 1) in vec4 colour;
uniform vec4 window;
uniform float size;
out vec4 shown;
void main() {
  gl_Position = vec4((place - window.xy) / window.zw * 2.0 - 1.0, 0.0, 1.0);
  gl_PointSize = size;
  shown = colour;
}`;

const FRAGMENT = `#version 300 es
precision mediump float;
in vec4 shown;
out vec4 colour;
void main() {
  if (shown.a == 0.0) discard;
  colour = shown;
}`;

interface Uploaded {
  readonly array: WebGLVertexArrayObject;
  readonly places: WebGLBuffer;
  readonly colours: WebGLBuffer;
  readonly count: number;
  /** Chainage and height that the places count from: float32 holds what is left of them to a micrometre. */
  readonly origin: readonly [chainage: number, height: number];
}

/** The points of a plot, by WebGL 2; those of each node are uploaded once. */
export class PlotCanvas {
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  readonly #canvas: HTMLCanvasElement;
  readonly #parts: Uploaded[] = [];

  /** @throws Error where the browser gives no WebGL 2 */
  constructor(canvas: HTMLCanvasElement) {
    const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser cannot draw a second picture");
    this.#gl = gl;
    this.#canvas = canvas;
    this.#program = programOf(gl);
  }

  /** Points that are in the picture. */
  get count(): number {
    return this.#parts.reduce((sum, { count }) => sum + count, 0);
  }

  clear(): void {
    for (const { array, places, colours } of this.#parts.splice(0)) {
      this.#gl.deleteVertexArray(array);
      this.#gl.deleteBuffer(places);
      this.#gl.deleteBuffer(colours);
    }
  }

  /** @param colours four bytes a point */
  add({ chainage, height }: ProfilePoints, colours: Uint8Array): void {
    const gl = this.#gl;
    const origin = [Math.floor(chainage[0]!), Math.floor(height[0]!)] as const;
    const places = new Float32Array(2 * chainage.length);
    for (let point = 0; point < chainage.length; point++) {
      places[2 * point] = chainage[point]! - origin[0];
      places[2 * point + 1] = height[point]! - origin[1];
    }
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const uploaded = {
      ...{ array, origin, count: chainage.length },
      places: attribute(gl, 0, places, 2, gl.FLOAT),
      colours: attribute(gl, 1, colours, 4, gl.UNSIGNED_BYTE),
    };
    gl.bindVertexArray(null);
    this.#parts.push(uploaded);
  }

  /** Gives the points of a part, counted in the order in which they came, other colours. */
  recolour(part: number, colours: Uint8Array): void {
    const gl = this.#gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#parts[part]!.colours);
    gl.bufferData(gl.ARRAY_BUFFER, colours as Uint8Array<ArrayBuffer>, gl.STATIC_DRAW);
  }

  /**
   * @param view what is seen, in the plot's rectangle
   * @param left edge of that rectangle, CSS pixels
   * @param bottom its lower edge, counted from below
   */
  draw({ shown, width, height }: PlotView, left: number, bottom: number): void {
    const gl = this.#gl;
    const ratio = devicePixelRatio;
    this.#canvas.width = Math.round(this.#canvas.clientWidth * ratio);
    this.#canvas.height = Math.round(this.#canvas.clientHeight * ratio);
    gl.viewport(left * ratio, bottom * ratio, width * ratio, height * ratio);
    // Points beyond the plot would stand in its margins otherwise.
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(left * ratio, bottom * ratio, width * ratio, height * ratio);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(this.#program);
    const window = gl.getUniformLocation(this.#program, "window");
    gl.uniform1f(gl.getUniformLocation(this.#program, "size"), Math.max(1.5, 1.5 * ratio));
    const { from, to, low, high } = shown;
    for (const { array, count, origin } of this.#parts) {
      gl.uniform4f(window, from - origin[0], low - origin[1], to - from, high - low);
      gl.bindVertexArray(array);
      gl.drawArrays(gl.POINTS, 0, count);
    }
    gl.bindVertexArray(null);
    gl.disable(gl.SCISSOR_TEST);
  }
}

function attribute(
  gl: WebGL2RenderingContext,
  index: number,
  data: Float32Array | Uint8Array,
  size: number,
  type: number,
): WebGLBuffer {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, data as Float32Array<ArrayBuffer>, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(index);
  gl.vertexAttribPointer(index, size, type, type === gl.UNSIGNED_BYTE, 0, 0);
  return buffer;
}

function programOf(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "");
  return program;
}

/** What is drawn: eye coordinates, metres, and colours of 8 bits. */
export interface PlainPoints {
  readonly positions: Float32Array<ArrayBuffer>;
  readonly colours: Uint8Array<ArrayBuffer>;
  /** Eye → clip, column-major. */
  readonly projection: readonly number[];
}

const VERTEX = `#version 300 es
in vec3 a_position;
in vec3 a_color;
out vec3 v_color;
uniform mat4 u_projection;
uniform float u_size;
void main() {
  gl_Position = u_projection * vec4(a_position, 1.0);
  gl_PointSize = u_size;
  v_color = a_color;
}`;

const FRAGMENT = `#version 300 es
precision mediump float;
in vec3 v_color;
out vec4 color;
void main() { color = vec4(v_color, 1.0); }`;

/** The least that the same points can be drawn by: one buffer, one call, two matrices, no library. */
export class PlainGl {
  readonly #gl: WebGL2RenderingContext;
  readonly #count: number;

  constructor(
    size: { readonly width: number; readonly height: number },
    points: PlainPoints,
    pixels: number,
  ) {
    const gl = contextOf(size);
    this.#gl = gl;
    this.#count = points.positions.length / 3;
    const program = linked(gl);
    show(gl, program, points.projection, pixels);
    gl.enable(gl.DEPTH_TEST);
    const attribute = (
      name: string,
      data: ArrayBufferView<ArrayBuffer>,
      type: number,
      normalized: boolean,
    ) => {
      const location = gl.getAttribLocation(program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, 3, type, normalized, 0, 0);
    };
    attribute("a_position", points.positions, gl.FLOAT, false);
    attribute("a_color", points.colours, gl.UNSIGNED_BYTE, true);
  }

  /** Draws a frame. */
  frame(): void {
    const gl = this.#gl;
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.drawArrays(gl.POINTS, 0, this.#count);
  }

  /** Waits until the GPU has drawn it. */
  wait(): void {
    const gl = this.#gl;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  destroy(): void {
    this.#gl.getExtension("WEBGL_lose_context")?.loseContext();
  }
}

function contextOf(size: { readonly width: number; readonly height: number }): WebGL2RenderingContext {
  const canvas = Object.assign(document.createElement("canvas"), size);
  const gl = canvas.getContext("webgl2", { antialias: false, powerPreference: "high-performance" });
  if (!gl) throw new Error("no WebGL 2");
  return gl;
}

function linked(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram();
  for (const [type, text] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) ?? "");
  return program;
}

/** Draws with a program from now on. */
function show(
  gl: WebGL2RenderingContext,
  program: WebGLProgram,
  projection: readonly number[],
  pixels: number,
): void {
  gl.useProgram(program);
  gl.uniformMatrix4fv(gl.getUniformLocation(program, "u_projection"), false, [...projection]);
  gl.uniform1f(gl.getUniformLocation(program, "u_size"), pixels);
}

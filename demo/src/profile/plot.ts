import type { ProfilePoints } from "@groma/layer/tools";
import { axisBottom, axisLeft } from "d3-axis";
import { scaleLinear } from "d3-scale";
import { select } from "d3-selection";
import { coloursOf, placesOf } from "./point-buffers.js";

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
  colour = shown;
}`;

/** Room for the axes, CSS pixels. */
const MARGIN = { left: 58, right: 12, top: 10, bottom: 34 } as const;

interface Uploaded {
  readonly array: WebGLVertexArrayObject;
  readonly buffers: readonly WebGLBuffer[];
  readonly count: number;
}

/** Chainage against height of the points of one profile, by WebGL 2; each node's points are uploaded once. */
export class ProfilePlot {
  readonly #gl: WebGL2RenderingContext;
  readonly #program: WebGLProgram;
  readonly #canvas: HTMLCanvasElement;
  readonly #axes: SVGSVGElement;
  readonly #parts: Uploaded[] = [];
  #length = 1;
  /** Height that buffers count from, metres. */
  #origin = Number.NaN;
  #least = Number.POSITIVE_INFINITY;
  #greatest = Number.NEGATIVE_INFINITY;
  #exaggeration = 1;
  #frame = 0;

  /** @throws Error where the browser gives no WebGL 2 */
  constructor(canvas: HTMLCanvasElement, axes: SVGSVGElement) {
    const gl = canvas.getContext("webgl2", { antialias: false, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser cannot draw a second picture");
    this.#gl = gl;
    this.#canvas = canvas;
    this.#axes = axes;
    this.#program = programOf(gl);
    new ResizeObserver(() => this.#ask()).observe(canvas);
  }

  /** Points that are in the picture. */
  get count(): number {
    return this.#parts.reduce((sum, { count }) => sum + count, 0);
  }

  /** How much heights are stretched against lengths; only the picture is. */
  get exaggeration(): number {
    return this.#exaggeration;
  }

  /** Begins another profile. @param length of its line, metres */
  clear(length: number): void {
    for (const { array, buffers } of this.#parts.splice(0)) {
      this.#gl.deleteVertexArray(array);
      for (const buffer of buffers) this.#gl.deleteBuffer(buffer);
    }
    this.#length = length;
    this.#origin = Number.NaN;
    this.#least = Number.POSITIVE_INFINITY;
    this.#greatest = Number.NEGATIVE_INFINITY;
    this.#ask();
  }

  /** @param bits that the scan's own colours have */
  add(points: ProfilePoints, bits: 8 | 16): void {
    if (Number.isNaN(this.#origin)) this.#origin = Math.floor(points.height[0]!);
    for (const height of points.height) {
      if (height < this.#least) this.#least = height;
      if (height > this.#greatest) this.#greatest = height;
    }
    const gl = this.#gl;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = [
      attribute(gl, 0, placesOf(points, this.#origin), 2, gl.FLOAT),
      attribute(gl, 1, coloursOf(points, bits), 4, gl.UNSIGNED_BYTE),
    ];
    gl.bindVertexArray(null);
    this.#parts.push({ array, buffers, count: points.height.length });
    this.#ask();
  }

  #ask(): void {
    this.#frame ||= requestAnimationFrame(() => {
      this.#frame = 0;
      this.#draw();
    });
  }

  #draw(): void {
    const ratio = devicePixelRatio;
    const [width, height] = [this.#canvas.clientWidth, this.#canvas.clientHeight];
    if (width === 0 || height === 0) return;
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    const gl = this.#gl;
    const [inner, high] = [width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
    const empty = !(this.#greatest >= this.#least);
    const x = scaleLinear([0, this.#length], [0, inner]);
    const [low, top] = empty ? [0, 1] : [this.#least, Math.max(this.#greatest, this.#least + 0.1)];
    const y = scaleLinear([low, top], [high, 0]).nice();
    const [bottom, above] = y.domain() as [number, number];
    this.#exaggeration = high / (above - bottom) / (inner / this.#length);
    gl.viewport(MARGIN.left * ratio, MARGIN.bottom * ratio, inner * ratio, high * ratio);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.useProgram(this.#program);
    const at = (name: string) => gl.getUniformLocation(this.#program, name);
    gl.uniform4f(at("window"), 0, bottom - (this.#origin || 0), this.#length, above - bottom);
    gl.uniform1f(at("size"), Math.max(1.5, 1.5 * ratio));
    for (const { array, count } of this.#parts) {
      gl.bindVertexArray(array);
      gl.drawArrays(gl.POINTS, 0, count);
    }
    gl.bindVertexArray(null);
    const svg = select(this.#axes).attr("viewBox", `0 0 ${width} ${height}`);
    svg.selectAll("*").remove();
    const place = (left: number, down: number) => `translate(${left},${down})`;
    svg
      .append("g")
      .attr("transform", place(MARGIN.left, height - MARGIN.bottom))
      .call(axisBottom(x).ticks(inner / 90));
    svg
      .append("g")
      .attr("transform", place(MARGIN.left, MARGIN.top))
      .call(axisLeft(y).ticks(high / 40));
    svg
      .append("text")
      .attr("x", width - MARGIN.right)
      .attr("y", height - 4)
      .attr("text-anchor", "end")
      .text(`chainage (m), heights × ${this.#exaggeration.toPrecision(2)}`);
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

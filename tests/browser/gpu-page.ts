import type { Page } from "playwright-core";
import type { PointShader, UniformDeclaration } from "../../layer/src/effects/index.js";

/** Texels as plain numbers: bytes as RGBA8, floats as RGBA32F. */
export interface PlainTexture {
  readonly name: string;
  readonly width: number;
  readonly height: number;
  readonly data: readonly number[];
  readonly float: boolean;
}

/** What a program draws, in plain values that cross to the page. */
export interface GpuRun {
  readonly vertex: string;
  readonly fragment: string;
  readonly declared: readonly UniformDeclaration[];
  readonly uniforms: Readonly<Record<string, number | readonly number[]>>;
  readonly textures: readonly PlainTexture[];
  readonly attributes: readonly {
    readonly name: string;
    readonly location: number;
    readonly components: number;
    readonly data: readonly number[];
  }[];
  readonly count: number;
  /** `vertices`: the outputs named, of each point; `picture`: colours and depths of what is drawn. */
  readonly wanted:
    | { readonly kind: "vertices"; readonly outputs: readonly string[] }
    | { readonly kind: "picture"; readonly size: number; readonly primitive: "points" | "triangle" };
}

/** Vertex outputs one point after the other; or RGBA and depth of each pixel, row by row from below. */
export type GpuResult = { readonly values: number[]; readonly depths: number[] };

/**
 * Attributes of a composed program from columns of plain numbers, normalised where the program wants it.
 * @param inSteps whether positions are stored at whole steps, in four numbers; else in metres, three
 */
export function columnsOf(
  shader: PointShader,
  columns: Readonly<Record<string, readonly number[]>>,
  inSteps = false,
): GpuRun["attributes"] {
  return shader.attributes.map(({ name, location, column, components, normalized }) => ({
    name,
    location,
    components: column === "position" && !inSteps ? 3 : components,
    data: normalized ? columns[column].map((value) => value / 255) : columns[column],
  }));
}

/** Runs a program in a page with WebGL 2. */
export function run(page: Page, work: GpuRun): Promise<GpuResult> {
  return page.evaluate(runInPage, work);
}

function runInPage(work: GpuRun): GpuResult {
  const { vertex, fragment, declared, uniforms, textures, attributes, count, wanted } = work;
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl?.getExtension("EXT_color_buffer_float")) throw new Error("no WebGL 2 with float pictures");
  const shader = (type: number, text: string) => {
    const made = gl.createShader(type)!;
    gl.shaderSource(made, text);
    gl.compileShader(made);
    if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made) ?? "");
    return made;
  };
  const link = (vertexText: string, fragmentText: string, outputs: readonly string[]) => {
    const made = gl.createProgram();
    gl.attachShader(made, shader(gl.VERTEX_SHADER, vertexText));
    gl.attachShader(made, shader(gl.FRAGMENT_SHADER, fragmentText));
    if (outputs.length > 0) gl.transformFeedbackVaryings(made, [...outputs], gl.INTERLEAVED_ATTRIBS);
    for (const { name, location } of attributes) gl.bindAttribLocation(made, location, name);
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made) ?? "");
    return made;
  };
  const outputs = wanted.kind === "vertices" ? wanted.outputs : [];
  const program = link(vertex, fragment, outputs);
  gl.useProgram(program);
  for (const { name, location, components, data } of attributes) {
    if (gl.getAttribLocation(program, name) !== location) throw new Error(`${name} is elsewhere`);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(data), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, components, gl.FLOAT, false, 0, 0);
  }
  for (const { name, type } of declared) {
    if (type === "sampler2D") continue;
    const at = gl.getUniformLocation(program, name);
    const value = uniforms[name];
    if (value === undefined) throw new Error(`${name} has no value`);
    if (type === "int") gl.uniform1i(at, value as number);
    else if (type === "float") gl.uniform1f(at, value as number);
    else if (type === "vec2") gl.uniform2fv(at, value as number[]);
    else if (type === "vec3") gl.uniform3fv(at, value as number[]);
    else if (type === "vec4") gl.uniform4fv(at, value as number[]);
    else gl.uniformMatrix4fv(at, false, value as number[]);
  }
  const texture = (width: number, height: number, format: number, data: ArrayBufferView | null) => {
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    const [layout, type] =
      format === gl.RGBA8
        ? [gl.RGBA, gl.UNSIGNED_BYTE]
        : format === gl.DEPTH_COMPONENT32F
          ? [gl.DEPTH_COMPONENT, gl.FLOAT]
          : [gl.RGBA, gl.FLOAT];
    gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, layout, type, data);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
      gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    }
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
      gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    }
    return made;
  };
  const made = textures.map(({ width, height, data, float }) =>
    texture(
      width,
      height,
      float ? gl.RGBA32F : gl.RGBA8,
      float ? new Float32Array(data) : new Uint8Array(data),
    ),
  );
  textures.forEach(({ name }, unit) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, made[unit]);
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  });
  if (wanted.kind === "vertices") {
    const floats = { gl_Position: 4, gl_PointSize: 1, v_color: 3 } as Record<string, number>;
    const each = outputs.reduce((sum, name) => sum + floats[name], 0);
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, null);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 4 * each * count, gl.STATIC_READ);
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, count);
    gl.endTransformFeedback();
    const values = new Float32Array(each * count);
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, values);
    return { values: [...values], depths: [] };
  }
  const { size, primitive } = wanted;
  gl.activeTexture(gl.TEXTURE0 + textures.length);
  const color = texture(size, size, gl.RGBA32F, null);
  const depth = texture(size, size, gl.DEPTH_COMPONENT32F, null);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  gl.viewport(0, 0, size, size);
  gl.enable(gl.DEPTH_TEST);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.drawArrays(primitive === "points" ? gl.POINTS : gl.TRIANGLES, 0, count);
  const values = new Float32Array(4 * size * size);
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, values);
  // Depths cannot be read but by drawing them.
  const copy = link(
    "#version 300 es\nvoid main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }",
    "#version 300 es\nprecision highp float;\nuniform highp sampler2D u_from;\nout vec4 to;\nvoid main() { to = texelFetch(u_from, ivec2(gl_FragCoord.xy), 0); }",
    [],
  );
  gl.useProgram(copy);
  gl.bindTexture(gl.TEXTURE_2D, depth);
  gl.uniform1i(gl.getUniformLocation(copy, "u_from"), textures.length);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  const out = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + textures.length + 1);
  gl.bindTexture(gl.TEXTURE_2D, out);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, size, size, 0, gl.RGBA, gl.FLOAT, null);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, out, 0);
  gl.disable(gl.DEPTH_TEST);
  for (const { location } of attributes) gl.disableVertexAttribArray(location);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const depths = new Float32Array(4 * size * size);
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, depths);
  return { values: [...values], depths: [...depths].filter((_, index) => index % 4 === 0) };
}

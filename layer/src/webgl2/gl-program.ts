import type { Destroyable } from "../drawing/gpu.js";
import type { PointShader, UniformDeclaration } from "../effects/index.js";
import { DrawError } from "../errors/index.js";
import type { GlTexture } from "./gl-types.js";
import type { GlUniforms, GlValue } from "./gl-uniforms.js";

/** A uniform as a linked program has it. */
interface Slot extends UniformDeclaration {
  readonly location: WebGLUniformLocation;
  /** Texture unit; of samplers only. */
  readonly unit: number;
}

/** A program that is compiled when it is first needed. */
export class GlProgram implements Destroyable {
  readonly #gl: WebGL2RenderingContext;
  readonly #shader: PointShader;
  #program: WebGLProgram | undefined;
  #slots: readonly Slot[] = [];

  constructor(gl: WebGL2RenderingContext, shader: PointShader) {
    this.#gl = gl;
    this.#shader = shader;
  }

  /** Compiles and links it, where that was not done before. @throws DrawError DRAW_PROGRAM */
  link(): void {
    if (this.#program) return;
    const gl = this.#gl;
    const { vertex, fragment, attributes, uniforms } = this.#shader;
    const program = gl.createProgram();
    const parts = [compile(gl, gl.VERTEX_SHADER, vertex), compile(gl, gl.FRAGMENT_SHADER, fragment)];
    for (const part of parts) gl.attachShader(program, part);
    for (const { name, location } of attributes) gl.bindAttribLocation(program, location, name);
    gl.linkProgram(program);
    const linked = gl.getProgramParameter(program, gl.LINK_STATUS);
    const log = [...parts.map((part) => gl.getShaderInfoLog(part)), gl.getProgramInfoLog(program)];
    for (const part of parts) gl.deleteShader(part);
    if (!linked && !gl.isContextLost()) {
      gl.deleteProgram(program);
      throw notLinked(log);
    }
    this.#program = program;
    let unit = 0;
    this.#slots = uniforms.flatMap((uniform): Slot[] => {
      const location = gl.getUniformLocation(program, uniform.name);
      if (!location) return [];
      return [{ ...uniform, location, unit: uniform.type === "sampler2D" ? unit++ : 0 }];
    });
  }

  /** Draws with it from now on, with these values. */
  use(values: GlUniforms): void {
    this.link();
    this.#gl.useProgram(this.#program ?? null);
    for (const slot of this.#slots) this.#set(slot, values.get(slot.name));
  }

  /** Changes an integer while it is in use. */
  setInteger(name: string, value: number): void {
    const slot = this.#slots.find((candidate) => candidate.name === name);
    if (slot) this.#gl.uniform1i(slot.location, value);
  }

  destroy(): void {
    if (this.#program) this.#gl.deleteProgram(this.#program);
    this.#program = undefined;
  }

  #set({ location, type, unit }: Slot, value: GlValue | undefined): void {
    const gl = this.#gl;
    if (value === undefined) return;
    if (typeof value === "number") {
      if (type === "int") gl.uniform1i(location, value);
      else gl.uniform1f(location, value);
    } else if ("texture" in value) {
      this.#setTexture(location, unit, value);
    } else if (type === "mat4") gl.uniformMatrix4fv(location, false, value as number[]);
    else if (type === "vec2") gl.uniform2fv(location, value as number[]);
    else if (type === "vec3") gl.uniform3fv(location, value as number[]);
    else gl.uniform4fv(location, value as number[]);
  }

  #setTexture(location: WebGLUniformLocation, unit: number, { texture }: GlTexture): void {
    const gl = this.#gl;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.uniform1i(location, unit);
  }
}

function compile(gl: WebGL2RenderingContext, type: number, text: string): WebGLShader {
  const shader = gl.createShader(type);
  // Null in a context that is lost, where nothing is drawn anyway.
  if (!shader) throw notLinked(["the context is lost"]);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return shader;
}

function notLinked(log: readonly (string | null)[]): DrawError {
  return new DrawError({
    code: "DRAW_PROGRAM",
    file: "shader",
    cause: `the browser does not compile it: ${log.filter(Boolean).join(" ").trim()}`,
    fix: "Report this together with the browser and its graphics card",
  });
}

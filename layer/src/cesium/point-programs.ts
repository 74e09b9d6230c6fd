import {
  composePass,
  composePointShader,
  type EffectPlan,
  type PointPass,
  type PointShader,
  type QuadPass,
  type UniformDeclaration,
} from "../effects/index.js";
import { type ShaderProgram, ShaderSource } from "./cesium-private.js";
import type { GpuObjects } from "./gpu-objects.js";

/** A program for points, with what it reads. */
export interface PointProgram {
  readonly program: ShaderProgram;
  readonly shader: PointShader;
}

/** A program for a quad over the whole picture. */
export interface QuadProgram {
  readonly program: ShaderProgram;
  readonly uniforms: readonly UniformDeclaration[];
}

/** Who draws with a program: Cesium, which derives others from it, or the layer itself. */
export type Drawer = "scene" | "own";

/** Programs by the set of active effects: two scenes that call for the same set share one. */
export class PointPrograms {
  readonly #objects: GpuObjects;
  readonly #points = new Map<string, PointProgram>();
  readonly #quads = new Map<string, QuadProgram>();

  constructor(objects: GpuObjects) {
    this.#objects = objects;
  }

  /**
   * The program of a pass, compiled when it first draws.
   * @param logarithmic whether it writes logarithmic depth; Cesium adds that itself where it draws
   */
  points(plan: EffectPlan, pass: PointPass, drawer: Drawer, logarithmic = false): PointProgram {
    const key = `${plan.key}|${pass}|${drawer}|${logarithmic}`;
    let found = this.#points.get(key);
    if (!found) {
      const shader = composePointShader(plan, "cesium", pass);
      const text = drawer === "own" && logarithmic ? withLogarithmicDepth(shader) : shader;
      const attributes = Object.fromEntries(shader.attributes.map(({ name, location }) => [name, location]));
      found = { shader, program: this.#objects.program({ ...text, attributes }) };
      this.#points.set(key, found);
    }
    return found;
  }

  quad(plan: EffectPlan, pass: QuadPass): QuadProgram {
    const key = `${plan.key}|${pass}`;
    let found = this.#quads.get(key);
    if (!found) {
      const { fragment, uniforms } = composePass(pass, plan, "cesium");
      const program = this.#objects.program({
        vertex: QUAD,
        fragment,
        attributes: { a_corner: 0 },
      });
      found = { program, uniforms };
      this.#quads.set(key, found);
    }
    return found;
  }

  destroy(): void {
    for (const { program } of [...this.#points.values(), ...this.#quads.values()])
      this.#objects.free(program);
    this.#points.clear();
    this.#quads.clear();
  }
}

/** One triangle over the whole picture, from corners at −1 and 3. */
const QUAD = `in vec2 a_corner;
out vec2 v_textureCoordinates;

void main() {
  v_textureCoordinates = a_corner * 0.5 + 0.5;
  gl_Position = vec4(a_corner, 0.0, 1.0);
}
`;

/** What Cesium makes of a program whose depth is to be logarithmic (`Scene/DerivedCommand`). */
function withLogarithmicDepth({ vertex, fragment }: Pick<PointShader, "vertex" | "fragment">) {
  const wrap = (text: string, call: string) =>
    `${ShaderSource.replaceMain(text, "groma_main")}\nvoid main() {\n  groma_main();\n  ${call}();\n}\n`;
  return {
    vertex: wrap(vertex, "czm_vertexLogDepth"),
    // Paraboloids write their depth themselves.
    fragment: /\bczm_writeLogDepth\(/.test(fragment) ? fragment : wrap(fragment, "czm_writeLogDepth"),
    defines: ["LOG_DEPTH"],
  };
}

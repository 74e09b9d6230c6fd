import type { FrameAllowance } from "../drawing/frame-allowance.js";
import type { Drawer, PointProgramNeed, ProgramNeed } from "../drawing/program-needs.js";
import {
  composePass,
  composePointShader,
  type EffectPlan,
  type PointPass,
  type PointShader,
  type QuadPass,
  type UniformDeclaration,
} from "../effects/index.js";
import { type ShaderProgram, ShaderSource } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { type AttributeSet, attributeSet } from "./vertex-attributes.js";

/** A program for points, with what it reads. */
export interface PointProgram {
  readonly program: ShaderProgram;
  readonly reads: AttributeSet;
}

/** A program for a quad over the whole picture. */
export interface QuadProgram {
  readonly program: ShaderProgram;
  readonly uniforms: readonly UniformDeclaration[];
}

/** Programs by the set of active effects: two scenes that call for the same set share one. */
export class PointPrograms {
  readonly #objects: GpuObjects;
  readonly #points = new Map<string, PointProgram>();
  readonly #quads = new Map<string, QuadProgram>();
  readonly #owner: object;
  readonly #linked = new Set<string>();

  /** @param owner the primitive */
  constructor(objects: GpuObjects, owner: object) {
    this.#objects = objects;
    this.#owner = owner;
  }

  /**
   * Makes and links programs before they are drawn with, one in a frame at most: the browser waits for the compiler.
   * @param derived whether Cesium adds logarithmic depth to those that it draws with
   * @returns whether all are linked
   */
  prepare(needs: readonly ProgramNeed[], derived: boolean, allowance: FrameAllowance): boolean {
    const keyOf = (need: ProgramNeed) => `${nameOf(need)}|${need.drawer !== "own" && derived}`;
    const open = needs.filter((need) => !this.#linked.has(keyOf(need)));
    if (open.length === 0) return true;
    if (!allowance.grants()) return false;
    const [next] = open;
    const isNew = !this.#points.has(nameOf(next)) && !this.#quads.has(nameOf(next));
    const { program } =
      next.drawer === "quad"
        ? this.quad(next.plan, next.pass)
        : this.points(next.plan, next.pass, next.drawer, next.logarithmic);
    // Its text took the time that there was.
    if (isNew && !allowance.left) return false;
    this.#objects.link(program, this.#owner, derived && next.drawer !== "own");
    this.#linked.add(keyOf(next));
    return open.length === 1;
  }

  /**
   * The program of a pass, compiled when it first draws.
   * @param logarithmic whether it writes logarithmic depth; Cesium adds that itself where it draws
   */
  points(plan: EffectPlan, pass: PointPass, drawer: Drawer, logarithmic = false): PointProgram {
    const key = nameOf({ plan, pass, drawer, logarithmic });
    let found = this.#points.get(key);
    if (!found) {
      const shader = composePointShader(plan, "cesium", pass);
      const text = drawer === "own" && logarithmic ? withLogarithmicDepth(shader) : shader;
      const attributes = Object.fromEntries(shader.attributes.map(({ name, location }) => [name, location]));
      const program = this.#objects.program({ ...text, attributes });
      found = { program, reads: attributeSet(shader.attributes) };
      this.#points.set(key, found);
    }
    return found;
  }

  /** What programs read of a node, each set of attributes once. */
  reads(needs: readonly PointProgramNeed[]): AttributeSet[] {
    const sets = new Map<string, AttributeSet>();
    for (const { plan, pass, drawer, logarithmic } of needs) {
      const { reads } = this.points(plan, pass, drawer, logarithmic);
      sets.set(reads.signature, reads);
    }
    return [...sets.values()];
  }

  quad(plan: EffectPlan, pass: QuadPass): QuadProgram {
    const key = nameOf({ plan, pass, drawer: "quad" });
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
    this.#linked.clear();
  }
}

/** What tells a program from all others. */
function nameOf(need: ProgramNeed): string {
  const name = `${need.plan.key}|${need.pass}|${need.drawer}`;
  return need.drawer === "quad" ? name : `${name}|${need.logarithmic}`;
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

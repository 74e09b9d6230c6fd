import { composePointShader, composeQuad, type PointShader, type ShaderTarget } from "../effects/index.js";
import type { FrameAllowance } from "./frame-allowance.js";
import type { Gpu, GpuTypes } from "./gpu.js";
import { isQuad, type PointProgramNeed, type ProgramNeed } from "./program-needs.js";
import { type AttributeSet, attributeSet } from "./vertex-attributes.js";

/** Programs that are kept although the last frame did not need them: those of some ten sets of effects. */
const IDLE = 24;

/** A program, and what it reads of each point. */
export interface Program<T extends GpuTypes> {
  readonly program: T["program"];
  readonly reads: AttributeSet;
}

interface Entry<T extends GpuTypes> extends Program<T> {
  /** Whether it is linked, by whether depth is logarithmic where it draws. */
  readonly linked: Set<boolean>;
  /** The frame that needed it last. */
  frame: number;
}

/**
 * Programs by the set of active effects: two scenes that call for the same set share one. Of those that are not needed
 * {@link IDLE} are kept, the ones needed last: styles and filters come in numbers without end.
 */
export class Programs<T extends GpuTypes> {
  readonly #gpu: Gpu<T>;
  readonly #entries = new Map<string, Entry<T>>();
  #frame = 0;
  /** Whether any program is linked. */
  #linked = false;

  constructor(gpu: Gpu<T>) {
    this.#gpu = gpu;
  }

  /** Begins a frame: frees programs that no frame needed for longest, where there are many. */
  nextFrame(): void {
    // What the last frame needed is needed in this one too, most likely.
    const idle = [...this.#entries].filter(([, { frame }]) => frame < this.#frame);
    this.#frame++;
    if (idle.length <= IDLE) return;
    idle.sort(([, a], [, b]) => a.frame - b.frame);
    for (const [key, { program }] of idle.slice(0, idle.length - IDLE)) {
      this.#entries.delete(key);
      this.#gpu.free(program);
    }
  }

  /**
   * Makes and links programs before they are drawn with, one in a frame at most: the browser waits for the compiler.
   * @returns whether all are linked
   */
  prepare(needs: readonly ProgramNeed[], allowance: FrameAllowance): boolean {
    const open = needs.filter((need) => !this.#use(need)?.linked.has(need.logarithmic));
    if (open.length === 0) return true;
    if (!allowance.grants()) return false;
    const [next] = open;
    const isNew = !this.#use(next);
    const { program, linked } = this.#entry(next);
    // Its text took the time that there was. The first program does not wait: nothing is shown yet, and the browser lets the
    // compiler wait for all that the scene draws until the next frame.
    if (isNew && this.#linked && !allowance.left) return false;
    this.#linked = true;
    this.#gpu.link(program, next);
    linked.add(next.logarithmic);
    return open.length === 1;
  }

  /** The program that a need is drawn with, compiled when it first draws. */
  of(need: ProgramNeed): Program<T> {
    return this.#entry(need);
  }

  /** What programs read of a node, each set of attributes once. */
  reads(needs: readonly PointProgramNeed[]): AttributeSet[] {
    const sets = new Map<string, AttributeSet>();
    for (const need of needs) {
      const { reads } = this.#entry(need);
      sets.set(reads.signature, reads);
    }
    return [...sets.values()];
  }

  destroy(): void {
    for (const { program } of this.#entries.values()) this.#gpu.free(program);
    this.#entries.clear();
  }

  #use(need: ProgramNeed): Entry<T> | undefined {
    const entry = this.#entries.get(keyOf(need));
    if (entry) entry.frame = this.#frame;
    return entry;
  }

  #entry(need: ProgramNeed): Entry<T> {
    const found = this.#use(need);
    if (found) return found;
    const shader = shaderOf(need, this.#gpu.target);
    const entry: Entry<T> = {
      program: this.#gpu.program(shader, need),
      reads: attributeSet(shader.attributes),
      linked: new Set(),
      frame: this.#frame,
    };
    this.#entries.set(keyOf(need), entry);
    return entry;
  }
}

/** The shader of a program; a quad over the whole picture reads nothing of points. */
function shaderOf(need: ProgramNeed, target: ShaderTarget): PointShader {
  if (isQuad(need)) return { ...composeQuad(need.plan, target), attributes: [] };
  return composePointShader(need.plan, target, need.pass);
}

/** What tells a program from all others. A view itself adds logarithmic depth to what draws into its scene. */
function keyOf({ plan, pass, into, logarithmic }: ProgramNeed): string {
  return `${plan.key}|${pass}|${into}|${into === "own" && logarithmic}`;
}

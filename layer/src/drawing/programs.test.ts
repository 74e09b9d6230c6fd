import { describe, expect, it } from "vitest";
import { planEffects } from "../effects/index.js";
import { richFacts, styleOf } from "../effects/scene.fixture.js";
import { WEBGL2 } from "../effects/webgl2-target.js";
import { FrameAllowance } from "./frame-allowance.js";
import type { Gpu, GpuTypes } from "./gpu.js";
import { type ProgramNeed, programsOf } from "./program-needs.js";
import { Programs } from "./programs.js";

const plan = planEffects(styleOf({ splats: true }), richFacts());
const own = { plan, into: "own", logarithmic: true } as const;
const quad: ProgramNeed = { plan, pass: "quad", into: "scene", logarithmic: true };
const needs: readonly ProgramNeed[] = [{ ...own, pass: "depth" }, { ...own, pass: "splat" }, quad];

/** Programs that are linked nowhere: which were made, which were linked for what, and how many are alive. */
function recorded() {
  const made: object[] = [];
  const alive = new Set<object>();
  const linked: (readonly [at: number, logarithmic: boolean])[] = [];
  const gpu = {
    target: WEBGL2,
    program: () => {
      const program = {};
      made.push(program);
      alive.add(program);
      return program;
    },
    link: (program: object, { logarithmic }: ProgramNeed) =>
      void linked.push([made.indexOf(program), logarithmic]),
    free: (program: object) => void alive.delete(program),
  } as unknown as Gpu<GpuTypes>;
  return { programs: new Programs(gpu), made, linked, alive };
}

describe("Programs", () => {
  it("links one program in a frame, whatever time there is, and each once", () => {
    const { programs, made, linked } = recorded();
    const done = [0, 1, 2, 3].map(() => programs.prepare(needs, new FrameAllowance(() => 0)));
    expect(done).toEqual([false, false, true, true]);
    expect(made).toHaveLength(3);
    expect(linked).toEqual([
      [0, true],
      [1, true],
      [2, true],
    ]);
  });

  it("links none in a frame that has no time left for it", () => {
    const { programs, made } = recorded();
    let now = 0;
    const allowance = new FrameAllowance(() => now);
    allowance.grants();
    now = 100;
    expect(programs.prepare(needs, allowance)).toBe(false);
    expect(made).toEqual([]);
  });

  it("links in a later frame what took a frame's time to write, but for the first program of all", () => {
    const { programs, made, linked } = recorded();
    let now = 0;
    const allowance = () => new FrameAllowance(() => now++, 1);
    const frames = [0, 1, 2].map(() => {
      const done = programs.prepare(needs.slice(0, 2), allowance());
      return [done, made.length, linked.length];
    });
    expect(frames).toEqual([
      [false, 1, 1],
      [false, 2, 1],
      [true, 2, 2],
    ]);
  });

  it("links the program of a scene anew where its depth becomes another, and makes one of the layer's own for each", () => {
    const { programs, made, linked } = recorded();
    const prepare = (need: ProgramNeed) => programs.prepare([need], new FrameAllowance(() => 0));
    expect([prepare(quad), prepare({ ...quad, logarithmic: false })]).toEqual([true, true]);
    expect([made.length, linked]).toEqual([
      1,
      [
        [0, true],
        [0, false],
      ],
    ]);
    expect([prepare(needs[0]), prepare({ ...own, pass: "depth", logarithmic: false })]).toEqual([true, true]);
    expect(made).toHaveLength(3);
  });

  it("keeps a number of programs that does not grow with the styles and filters that were shown", () => {
    const { programs, alive, made } = recorded();
    const depth = { own: true, scene: true };
    const planOf = (at: number) =>
      planEffects(
        styleOf({
          splats: at % 2 === 0,
          eyeDomeLighting: at % 3 === 0,
          size: "fixed",
          gamma: 1 + (at % 2),
        }),
        richFacts({ filter: { ranges: { [`column${at}`]: [0, 1] } } }),
      );
    const first = programsOf(planOf(0), depth);
    const show = (needs: readonly ProgramNeed[]) => {
      programs.nextFrame();
      for (const need of needs) programs.of(need);
    };
    for (let at = 0; at < 300; at++) show(programsOf(planOf(at), depth));
    expect(made.length).toBeGreaterThan(300);
    expect(alive.size).toBeLessThan(40);
    // What is drawn is never freed, however many others come.
    const drawn = programsOf(planOf(300), depth);
    show(drawn);
    const kept = drawn.map((need) => programs.of(need).program);
    for (let at = 301; at < 400; at++) show([...programsOf(planOf(at), depth), ...drawn]);
    expect(kept.every((program) => alive.has(program))).toBe(true);
    const before = made.length;
    show(first);
    expect(made.length).toBe(before + first.length);
    programs.destroy();
    expect(alive.size).toBe(0);
  });
});

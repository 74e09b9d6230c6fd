import { describe, expect, it } from "vitest";
import { FrameAllowance } from "../drawing/frame-allowance.js";
import type { ProgramNeed } from "../drawing/program-needs.js";
import { planEffects } from "../effects/index.js";
import { richFacts, styleOf } from "../effects/scene.fixture.js";
import type { ShaderProgram } from "./engine/cesium-private.js";
import type { GpuObjects } from "./engine/gpu-objects.js";
import { PointPrograms } from "./point-programs.js";

const plan = planEffects(styleOf({ highQuality: true }), richFacts());
const own = { plan, drawer: "own", logarithmic: true } as const;
const needs: readonly ProgramNeed[] = [
  { ...own, pass: "depth" },
  { ...own, pass: "splat" },
  { plan, pass: "splatNormalise", drawer: "quad" },
];

/** Programs that are linked nowhere: which were made, and which were linked with what. */
function recorded() {
  const made: object[] = [];
  const linked: (readonly [at: number, logarithmic: boolean])[] = [];
  const objects = {
    program: () => made[made.push({}) - 1],
    link: (program: ShaderProgram, _owner: object, logarithmic: boolean) =>
      void linked.push([made.indexOf(program), logarithmic]),
  } as unknown as GpuObjects;
  return { programs: new PointPrograms(objects, {}), made, linked };
}

describe("PointPrograms", () => {
  it("links one program in a frame, whatever time there is, and each once", () => {
    const { programs, made, linked } = recorded();
    const done = [0, 1, 2, 3].map(() => programs.prepare(needs, true, new FrameAllowance(() => 0)));
    expect(done).toEqual([false, false, true, true]);
    expect(made).toHaveLength(3);
    // Cesium adds logarithmic depth to what it draws itself.
    expect(linked).toEqual([
      [0, false],
      [1, false],
      [2, true],
    ]);
  });

  it("links none in a frame that has no time left for it", () => {
    const { programs, made } = recorded();
    let now = 0;
    const allowance = new FrameAllowance(() => now);
    allowance.grants();
    now = 100;
    expect(programs.prepare(needs, false, allowance)).toBe(false);
    expect(made).toEqual([]);
  });

  it("links in a later frame what took a frame's time to write", () => {
    const { programs, made, linked } = recorded();
    let now = 0;
    const allowance = () => new FrameAllowance(() => now++, 1);
    const frames = [0, 1, 2].map(() => {
      const done = programs.prepare(needs.slice(0, 1), false, allowance());
      return [done, made.length, linked.length];
    });
    expect(frames).toEqual([
      [false, 1, 0],
      [true, 1, 1],
      [true, 1, 1],
    ]);
  });

  it("links what Cesium draws anew where it derives another program", () => {
    const { programs, linked } = recorded();
    const scene: ProgramNeed[] = [{ plan, pass: "color", drawer: "scene", logarithmic: false }];
    const frame = () => new FrameAllowance(() => 0);
    expect(programs.prepare(scene, true, frame())).toBe(true);
    expect(programs.prepare(scene, false, frame())).toBe(true);
    expect(linked).toEqual([
      [0, true],
      [0, false],
    ]);
  });
});

import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { composePointShader, composeQuad, passesOf, planEffects } from "../../layer/src/effects/index.js";
import { combinations } from "../../layer/src/effects/scene.fixture.js";
import { WEBGL2 } from "../../layer/src/effects/webgl2-target.js";
import { sharedBrowser } from "./harness.js";

/** As both views have their programs: what belongs to a node comes in a table, and one call draws many nodes of it. */
const TARGET = { ...WEBGL2, nodeTable: true, manyDraws: true };

/** A program as the page compiles it, and what it is expected to read. */
interface Case {
  readonly name: string;
  readonly vertex: string;
  readonly fragment: string;
  readonly attributes: readonly string[];
  readonly uniforms: readonly string[];
}

/** One program for each text that any combination of effects composes to. */
function cases(): Case[] {
  const byText = new Map<string, Case>();
  const add = (one: Case) => byText.set(one.vertex + one.fragment, one);
  for (const { name, style, facts } of combinations()) {
    const plan = planEffects(style, facts);
    for (const pass of ["color", "id", "depth", "splat"] as const) {
      if ((pass === "splat" || pass === "depth") && !plan.active.has("splats")) continue;
      const { vertex, fragment, attributes, uniforms } = composePointShader(plan, TARGET, pass);
      add({
        name: `${name}: ${pass}`,
        vertex,
        fragment,
        attributes: attributes.map((attribute) => attribute.name),
        uniforms: uniforms.map((uniform) => uniform.name),
      });
    }
    if (passesOf(plan).offscreen) {
      const { vertex, fragment, uniforms } = composeQuad(plan, TARGET);
      add({
        name: `${name}: quad`,
        vertex,
        fragment,
        attributes: [],
        uniforms: uniforms.map((u) => u.name),
      });
    }
  }
  return [...byText.values()];
}

/** In the page: compiles and links programs; says which fail, and which of their names are not active. */
function compileAll(programs: readonly Case[]): string[] {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl?.getExtension("WEBGL_multi_draw")) return ["no WebGL 2, or no calls that draw many"];
  const faults: string[] = [];
  const shaders = new Map<string, WebGLShader>();
  const shader = (type: number, text: string) => {
    const made = shaders.get(text) ?? gl.createShader(type)!;
    if (!shaders.has(text)) {
      gl.shaderSource(made, text);
      gl.compileShader(made);
      shaders.set(text, made);
    }
    return made;
  };
  for (const { name, vertex, fragment, attributes, uniforms } of programs) {
    const program = gl.createProgram();
    const both = [shader(gl.VERTEX_SHADER, vertex), shader(gl.FRAGMENT_SHADER, fragment)];
    for (const one of both) gl.attachShader(program, one);
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      const logs = [...both.map((one) => gl.getShaderInfoLog(one)), gl.getProgramInfoLog(program)];
      faults.push(`${name}: ${logs.join(" ")}`);
    } else {
      for (const attribute of attributes) {
        if (gl.getAttribLocation(program, attribute) < 0) faults.push(`${name}: ${attribute} is not read`);
      }
      for (const uniform of uniforms) {
        if (gl.getUniformLocation(program, uniform) === null) faults.push(`${name}: ${uniform} is not read`);
      }
    }
    gl.deleteProgram(program);
  }
  return faults;
}

describe("programs of all combinations of effects", () => {
  let browser: Browser;
  let programs: readonly Case[];
  beforeAll(async () => {
    browser = await sharedBrowser();
    programs = cases();
  });
  afterAll(() => browser?.close());

  it("compile and link in WebGL 2, and read all that they declare", { timeout: 300_000 }, async () => {
    expect(programs.length).toBeGreaterThan(500);
    const page = await browser.newPage();
    const faults: string[] = [];
    for (let from = 0; from < programs.length; from += 200) {
      faults.push(...(await page.evaluate(compileAll, programs.slice(from, from + 200))));
    }
    expect(faults.slice(0, 5)).toEqual([]);
    await page.close();
  });

  it("are refused where they are wrong (negative control)", async () => {
    const [one] = programs;
    const page = await browser.newPage();
    const broken = { ...one, vertex: one.vertex.replace("gl_Position", "gl_Positron") };
    const unread = { ...one, uniforms: [...one.uniforms, "u_nothing"] };
    expect(await page.evaluate(compileAll, [broken, unread])).toHaveLength(2);
    await page.close();
  });
});

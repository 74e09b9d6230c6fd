import { describe, expect, it } from "vitest";
import type { UniformDeclaration } from "./declaration/shader.js";
import { nodeLayout } from "./node-layout.js";
import { readBy, shaderText, stagedStatements, unique } from "./shader-text.js";
import { WEBGL2 } from "./webgl2-target.js";

const uniform = (name: string, type: UniformDeclaration["type"] = "float"): UniformDeclaration => ({
  ...{ name, type, scope: "layer" },
});
const source = (statements: string[], rest: Partial<Parameters<typeof shaderText>[1]> = {}) => ({
  ...{ uniforms: [], declarations: [], functions: [], statements },
  ...rest,
});

describe("the text of a shader", () => {
  it("declares what it reads, once, and nothing else", () => {
    const uniforms = [uniform("u_a"), uniform("u_ab"), uniform("u_a"), uniform("u_map", "sampler2D")];
    const text = shaderText(WEBGL2, source(["float x = u_a + texelFetch(u_map, p, 0).r;"], { uniforms }));
    expect(text.match(/^uniform .*;$/gm)).toEqual(["uniform float u_a;", "uniform highp sampler2D u_map;"]);
    expect(text.startsWith(WEBGL2.header)).toBe(true);
    expect(text).toContain("void main() {\n  float x = u_a + texelFetch(u_map, p, 0).r;\n}\n");
  });

  it("has each function once, before main, and declarations before the uniforms", () => {
    const functions = [
      "\nfloat f() { return 1.0; }\n",
      "float f() { return 1.0; }",
      "float g() { return u_a; }",
    ];
    const text = shaderText(
      WEBGL2,
      source(["f();"], { functions, declarations: ["in vec3 a_position;"], uniforms: [uniform("u_a")] }),
    );
    expect(text.slice(WEBGL2.header.length)).toBe(
      [
        ...["in vec3 a_position;", "uniform float u_a;", "", "float f() { return 1.0; }"],
        ...["float g() { return u_a; }", "void main() {", "  f();", "}", ""],
      ].join("\n"),
    );
  });

  it("reads the row of a node by the draw where one call draws many, and says so after the version alone", () => {
    const node: UniformDeclaration = { name: "u_level", type: "float", scope: "node" };
    const asked = source(["float x = u_level;"], { uniforms: [node], nodes: nodeLayout([node]) });
    const textFor = (manyDraws: boolean) => shaderText({ ...WEBGL2, nodeTable: true, manyDraws }, asked);
    const [version, ...rest] = WEBGL2.header.split("\n");
    const header = [version, "#extension GL_ANGLE_multi_draw : require", ...rest].join("\n");
    expect(textFor(true).startsWith(header)).toBe(true);
    expect(textFor(true)).toContain("int ofNode = (u_node + gl_DrawID) * 1;");
    expect(textFor(false).startsWith(WEBGL2.header)).toBe(true);
    expect(textFor(false)).toContain("int ofNode = u_node * 1;");
    // Cesium writes the version itself, and brings extensions to the top.
    const bare = shaderText({ ...WEBGL2, header: "", nodeTable: true, manyDraws: true }, asked);
    expect(bare.startsWith("#extension GL_ANGLE_multi_draw : require\n")).toBe(true);
  });

  it("says words as the target does, and knows no others", () => {
    const text = shaderText(WEBGL2, source(["vec4 p = $projection * $modelView * q;"]));
    const { projection, modelView } = WEBGL2.words;
    expect(text).toContain(`vec4 p = ${projection} * ${modelView} * q;`);
    for (const word of ["view", "toString", "constructor"]) {
      const attempt = () => shaderText(WEBGL2, source([`x = $${word};`]));
      expect(attempt, word).toThrow(`shaders know no word $${word}`);
    }
  });
});

describe("statements of stages", () => {
  const stages = ["first", "second"] as const;

  it("come stage by stage, in the order of their parts", () => {
    const parts = [{ second: "d;" }, undefined, { first: "a;\nb;", second: "\n  e;\n" }, { first: "c;" }];
    expect(stagedStatements(stages, parts)).toEqual(["a;", "b;", "c;", "d;", "e;"]);
  });

  it("come in once where their stage is shared", () => {
    const parts = [
      { first: "a;\nb;", second: "d;" },
      { first: "a;", second: "d;" },
    ];
    expect(stagedStatements(stages, parts, ["first"])).toEqual(["a;", "b;", "d;", "d;"]);
  });
});

it("names are told apart as words, and the last of a name counts", () => {
  const all = [uniform("u_a"), uniform("u_a", "int"), uniform("u_b")];
  expect(unique(all)).toEqual([uniform("u_a", "int"), uniform("u_b")]);
  expect(readBy("u_ab + xu_b + u_a", all).map(({ name }) => name)).toEqual(["u_a"]);
});

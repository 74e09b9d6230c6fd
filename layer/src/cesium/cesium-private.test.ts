import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import * as Cesium from "cesium";
import { describe, expect, it } from "vitest";
import * as own from "./cesium-private.js";

const require = createRequire(import.meta.url);
const engine = dirname(createRequire(require.resolve("cesium")).resolve("@cesium/engine/package.json"));
const source = (path: string) => readFileSync(join(engine, "Source", path), "utf8");

/** Everything that is exported, documented or not. */
const exported = Cesium as Record<string, unknown>;

describe(`undocumented parts of Cesium ${exported.VERSION}`, () => {
  it.each(Object.entries(own))("exports %s", (name, value) => {
    expect(value).toBeDefined();
    expect(value).toBe(exported[name]);
  });

  it("has the static functions and values that are called", () => {
    expect(own.Buffer.createVertexBuffer).toBeTypeOf("function");
    expect(own.BufferUsage.STATIC_DRAW).toBeTypeOf("number");
    expect(own.Pass.OPAQUE).toBeTypeOf("number");
    expect(own.RenderState.fromCache).toBeTypeOf("function");
    expect(own.RenderState.removeFromCache).toBeTypeOf("function");
    expect(own.ShaderProgram.fromCache).toBeTypeOf("function");
  });

  it.each([
    ["Renderer/Context.js", ["createPickId", "this._gl", "drawingBufferHeight"]],
    ["Renderer/PickId.js", ["this.color", "destroy()"]],
    ["Renderer/VertexArray.js", ["vertexArrayDestroyable", "strideInBytes", "componentsPerAttribute"]],
    ["Scene/DerivedCommand.js", ["czm_log_depth_main", "czm_non_pick_main", "createLogDepthCommand"]],
    [
      "Renderer/DrawCommand.js",
      ["modelMatrix", "boundingVolume", "pickId", "shaderProgram", "uniformMap", "primitiveType"],
    ],
    [
      "Scene/FrameState.js",
      [
        "commandList",
        "afterRender",
        "cullingVolume",
        "occluder",
        "passes",
        "render: false",
        "pick: false",
        "depth: false",
      ],
    ],
  ])("%s still has what the layer relies on", (path, words) => {
    const text = source(path);
    expect(words.filter((word) => !text.includes(word))).toEqual([]);
  });

  it("asks for another frame where a function of afterRender returns true", () => {
    expect(source("Scene/Scene.js")).toMatch(/afterRender[\s\S]{0,400}requestRender/);
  });

  it("knows the built-in uniforms and functions that the shaders use", () => {
    const uniforms = source("Renderer/AutomaticUniforms.js");
    for (const name of ["czm_modelView", "czm_projection", "czm_pixelRatio"])
      expect(uniforms).toContain(name);
    expect(source("Shaders/Builtin/CzmBuiltins.js")).toContain("czm_gammaCorrect");
  });
});

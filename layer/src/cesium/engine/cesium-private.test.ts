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
    expect(own.Pass.TRANSLUCENT).toBeTypeOf("number");
    expect(own.Sampler.NEAREST).toBeTypeOf("object");
    expect(own.ShaderSource).toBeTypeOf("function");
    expect(own.Sync.create).toBeTypeOf("function");
    expect(own.RenderState.fromCache).toBeTypeOf("function");
    expect(own.RenderState.removeFromCache).toBeTypeOf("function");
    expect(own.ShaderProgram.fromCache).toBeTypeOf("function");
    expect(own.DerivedCommand.createLogDepthCommand).toBeTypeOf("function");
  });

  it.each([
    [
      "Renderer/Context.js",
      [
        "createPickId",
        "this._gl",
        "drawingBufferHeight",
        "drawingBufferWidth",
        "prototype.readPixelsToPBO",
        "prototype.endFrame",
        "uniformState",
        "colorBufferHalfFloat",
        "va._bind()",
        "va.numberOfVertices",
      ],
    ],
    ["Renderer/UniformState.js", ["prototype.update = ", "prototype.updateFrustum = "]],
    ["Renderer/Buffer.js", ["this.vertexArrayDestroyable = true", "prototype.getBufferData"]],
    ["Renderer/Framebuffer.js", ["options.colorTextures", "options.depthTexture", "this.destroyAttachments"]],
    ["Renderer/Texture.js", ["source.arrayBufferView", "prototype.copyFrom", "sizeInBytes"]],
    ["Renderer/Sync.js", ["prototype.getStatus"]],
    ["Renderer/PassState.js", ["this.framebuffer", "this.viewport"]],
    ["Renderer/PickId.js", ["this.color", "destroy()"]],
    // Constant attributes are set at each draw, since they are no part of a vertex array.
    [
      "Renderer/VertexArray.js",
      ["vertexArrayDestroyable", "setConstantAttributes", "componentsPerAttribute", "_bind = ", "_unBind = "],
    ],
    ["Scene/DerivedCommand.js", ["czm_log_depth_main", "czm_non_pick_main", "createLogDepthCommand"]],
    [
      "Renderer/DrawCommand.js",
      ["modelMatrix", "boundingVolume", "pickId", "shaderProgram", "uniformMap", "primitiveType"],
    ],
    ["Scene/Camera.js", ["this._scene = scene"]],
    [
      "Scene/FrameState.js",
      [
        "commandList",
        "afterRender",
        "cullingVolume",
        "occluder",
        "pixelRatio",
        "useLogDepth",
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

  it("takes nothing but clear commands into every frustum, in the order of the list", () => {
    expect(source("Scene/View.js")).toMatch(/command instanceof ClearCommand[\s\S]{0,200}frustum\.near/);
    expect(source("Scene/Scene.js")).toMatch(/command instanceof ClearCommand\) \{\s+command\.execute/);
  });

  it("links a program when its attributes are counted, and finds a derived one again", () => {
    expect(source("Renderer/ShaderProgram.js")).toMatch(
      /numberOfVertexAttributes: \{\s+get: function \(\) \{\s+initialize/,
    );
    expect(source("Scene/DerivedCommand.js")).toMatch(
      /getDerivedShaderProgram\(\s+shaderProgram,\s+"logDepth"/,
    );
  });

  it("leaves shaders alone that write logarithmic depth themselves, or name the call", () => {
    expect(source("Scene/DerivedCommand.js")).toContain("writeLogDepthRegex = /\\s+czm_writeLogDepth\\(/");
    expect(source("Scene/DerivedCommand.js")).toContain("vertexlogDepthRegex = /\\s+czm_vertexLogDepth\\(/");
    expect(source("Renderer/ShaderSource.js")).toMatch(/combinedSources = removeComments\(combinedSources\)/);
  });

  it("asks for another frame where a function of afterRender returns true", () => {
    expect(source("Scene/Scene.js")).toMatch(/afterRender[\s\S]{0,400}requestRender/);
  });

  it("knows the built-in uniforms and functions that the shaders use", () => {
    const uniforms = source("Renderer/AutomaticUniforms.js");
    for (const name of [
      "czm_modelView",
      "czm_projection",
      "czm_pixelRatio",
      "czm_viewport",
      "czm_currentFrustum",
      "czm_oneOverLog2FarDepthFromNearPlusOne",
    ])
      expect(uniforms).toContain(name);
    for (const name of ["czm_gammaCorrect", "czm_vertexLogDepth", "czm_writeLogDepth"])
      expect(source("Shaders/Builtin/CzmBuiltins.js")).toContain(name);
  });
});

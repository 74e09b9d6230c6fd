import { existsSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { pathToFileURL } from "node:url";
import * as Cesium from "cesium";
import { beforeAll, describe, expect, it } from "vitest";
import * as own from "./cesium-private.js";

const require = createRequire(import.meta.url);

/** The engine of the Cesium that is installed, and that of the oldest one that the package takes. */
const engines = [
  createRequire(require.resolve("cesium")).resolve("@cesium/engine/package.json"),
  require.resolve("cesium-engine-oldest/package.json"),
].map((path) => {
  const folder = dirname(path);
  const version = /CESIUM_VERSION = "([\d.]+)"/.exec(readFileSync(join(folder, "index.js"), "utf8"))![1]!;
  return { version, folder };
});

describe("the Cesium that the package takes", () => {
  it("is from the oldest to the newest that it is held against", () => {
    const { peerDependencies } = require("../../../package.json") as {
      peerDependencies: { cesium: string };
    };
    const [newest, oldest] = engines.map(({ version }) => version);
    const [major, minor] = newest!.split(".").map(Number);
    expect(peerDependencies.cesium).toBe(`>=${oldest} <${major}.${minor! + 1}.0`);
  });
});

describe.each(engines)("undocumented parts of Cesium $version", ({ version, folder }) => {
  const source = (path: string) => readFileSync(join(folder, "Source", path), "utf8");
  /** Everything that is exported, documented or not. */
  let exported: Record<string, unknown>;
  beforeAll(async () => {
    exported = await import(pathToFileURL(join(folder, "index.js")).href);
  }, 60_000);
  /** What is called by name of what is exported. */
  const part = (name: string) => exported[name] as Record<string, unknown>;

  it("exports all that is used", () => {
    expect(Object.keys(own).filter((name) => exported[name] === undefined)).toEqual([]);
    if (version !== (Cesium as Record<string, unknown>).VERSION) return;
    for (const [name, value] of Object.entries(own)) expect([name, value]).toEqual([name, exported[name]]);
  });

  it("has the static functions and values that are called", () => {
    expect(part("Buffer").createVertexBuffer).toBeTypeOf("function");
    expect(part("BufferUsage").STATIC_DRAW).toBeTypeOf("number");
    expect(part("Pass").OPAQUE).toBeTypeOf("number");
    expect(part("Pass").TRANSLUCENT).toBeTypeOf("number");
    expect(part("Sampler").NEAREST).toBeTypeOf("object");
    expect(part("ShaderSource")).toBeTypeOf("function");
    expect(part("Sync").create).toBeTypeOf("function");
    expect(part("RenderState").fromCache).toBeTypeOf("function");
    expect(part("RenderState").removeFromCache).toBeTypeOf("function");
    expect(part("ShaderProgram").fromCache).toBeTypeOf("function");
    expect(part("DerivedCommand").createLogDepthCommand).toBeTypeOf("function");
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
    [
      "Renderer/Buffer.js",
      ["this.vertexArrayDestroyable = true", "prototype.getBufferData", "prototype.copyFromArrayView"],
    ],
    [
      "Renderer/Framebuffer.js",
      [
        "options.colorTextures",
        "options.depthTexture",
        "this.destroyAttachments",
        "prototype.bindDraw",
        "prototype.bindRead",
      ],
    ],
    ["Renderer/Texture.js", ["source.arrayBufferView", "prototype.copyFrom", "sizeInBytes"]],
    ["Renderer/Sync.js", ["prototype.getStatus"]],
    ["Renderer/PassState.js", ["this.framebuffer", "this.viewport"]],
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

  it("has colours of picks that can be given back", () => {
    // Later ones have a file of their own.
    const own = "Renderer/PickId.js";
    const text = source(existsSync(join(folder, "Source", own)) ? own : "Renderer/Context.js");
    expect(text).toMatch(/class PickId|function PickId/);
    expect(text).toContain("this.color = color");
    expect(text).toMatch(/PickId\.prototype\.destroy|destroy\(\) \{/);
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

  it("brings extensions of a shader to the top", () => {
    expect(source("Renderer/ShaderSource.js")).toMatch(/#extension[\s\S]{0,200}extensions\.push\(match\)/);
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

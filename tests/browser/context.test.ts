import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { decode, difference, openStage, type StagePage } from "./stage.js";

const POSE = { range: 26, pitch: -35, heading: 30 };

describe.skipIf(pythonMissing)(
  `the graphics context${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage();
    }, 120_000);
    afterAll(() => stage?.close());

    it("is lost and comes back: the layer frees what it had, and draws again", {
      timeout: 60_000,
    }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const { Stage } = window.page;
        const style = { pointSize: 4, eyeDomeLighting: true, color: "elevation" } as const;
        const stage = new Stage();
        const layer = await stage.show("steps", { style });
        stage.look(pose);
        await stage.settle();
        const before = stage.picture();
        const counts = () =>
          Object.values(layer.statistics.gpuObjects).reduce((sum, count) => sum + count, 0);
        const alive = counts();
        const { canvas } = stage.scene;
        const event = (name: string) =>
          new Promise<void>((resolve) => {
            canvas.addEventListener(
              name,
              (happened) => {
                happened.preventDefault();
                resolve();
              },
              { once: true },
            );
          });
        const extension = stage.gl.getExtension("WEBGL_lose_context")!;
        const lost = event("webglcontextlost");
        const pending = layer.pick({ x: 128, y: 96 });
        extension.loseContext();
        await lost;
        const whileLost = { alive: counts(), picked: (await pending) === undefined };
        const restored = event("webglcontextrestored");
        extension.restoreContext();
        await restored;
        // Cesium does not make its own objects anew: the application makes a new viewer, and the layer goes there.
        stage.scene.primitives.destroyPrimitives = false;
        stage.scene.primitives.remove(layer);
        stage.destroy();
        const fresh = new Stage();
        fresh.scene.primitives.add(layer);
        fresh.layer = layer;
        fresh.look(pose);
        await fresh.settle();
        const after = fresh.picture();
        const picked = (await layer.pick({ x: 128, y: 96 }))?.node;
        const errors = fresh.errors();
        fresh.destroy();
        return { before, after, alive, whileLost, picked, errors, left: counts() };
      }, POSE);
      expect(result.errors).toEqual([]);
      expect(result.alive).toBeGreaterThan(5);
      expect(result.whileLost).toEqual({ alive: 0, picked: true });
      expect(result.picked).toBeDefined();
      expect(result.left).toBe(0);
      expect(difference(decode(result.before, "context-before"), decode(result.after, "context-after"))).toBe(
        0,
      );
    });

    it("is lost and comes back between two frames: the layer makes its own objects anew in it", {
      timeout: 30_000,
    }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const { Stage } = window.page;
        const stage = new Stage();
        const layer = await stage.show("steps", { style: { pointSize: 4, eyeDomeLighting: true } });
        stage.look(pose);
        await stage.settle();
        const { canvas } = stage.scene;
        const extension = stage.gl.getExtension("WEBGL_lose_context")!;
        const back = new Promise<void>((resolve) => {
          canvas.addEventListener("webglcontextlost", (event) => {
            event.preventDefault();
            setTimeout(() => extension.restoreContext(), 0);
          });
          canvas.addEventListener("webglcontextrestored", () => resolve());
        });
        extension.loseContext();
        await back;
        // What Cesium itself draws with is gone; the layer's part of a frame has to work nevertheless.
        const { frameState } = stage.scene as unknown as { frameState: Record<string, unknown> };
        for (const name of stage.gl.getSupportedExtensions() ?? []) stage.gl.getExtension(name);
        const passes = { render: true, pick: false, depth: false };
        const frame = Object.assign(Object.create(frameState), { passes, commandList: [], afterRender: [] });
        stage.errors();
        for (let at = 0; at < 5; at++) layer.update(frame);
        const { buffers, programs } = layer.statistics.gpuObjects;
        const picked = (await layer.pick({ x: 128, y: 96 }))?.node;
        const errors = stage.errors();
        layer.destroy();
        return { buffers, programs, picked, errors, left: layer.statistics.gpuObjects };
      }, POSE);
      expect(result.errors).toEqual([]);
      expect(result.buffers).toBeGreaterThan(0);
      expect(result.programs).toBeGreaterThan(0);
      expect(result.picked).toBeDefined();
      expect(Object.values(result.left).every((count) => count === 0)).toBe(true);
    });

    it("has nothing of the layer left after destroy()", { timeout: 60_000 }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const { Stage, Cesium } = window.page;
        const stage = new Stage();
        const { gl, scene } = stage;
        const alive: Record<string, Set<unknown>> = {};
        for (const kind of [
          "Buffer",
          "Texture",
          "Framebuffer",
          "VertexArray",
          "Program",
          "Shader",
          "Query",
          "Renderbuffer",
        ]) {
          const objects = new Set<unknown>();
          alive[kind] = objects;
          const methods = gl as unknown as Record<string, (...args: unknown[]) => unknown>;
          const create = methods[`create${kind}`]!.bind(gl);
          const remove = methods[`delete${kind}`]!.bind(gl);
          methods[`create${kind}`] = (...args) => {
            const object = create(...args);
            objects.add(object);
            return object;
          };
          methods[`delete${kind}`] = (object) => {
            objects.delete(object);
            return remove(object);
          };
        }
        const count = () => Object.fromEntries(Object.entries(alive).map(([kind, { size }]) => [kind, size]));
        const use = async () => {
          const layer = await stage.show("steps", { style: { pointSize: 4, color: "elevation" } });
          stage.look(pose);
          await stage.settle();
          for (const style of [{ eyeDomeLighting: true }, { splats: true }, { size: "adaptive" as const }]) {
            layer.style = style;
            await stage.settle();
          }
          await layer.pick({ x: 128, y: 96 });
          scene.pick(new Cesium.Cartesian2(128, 96));
          const during = { own: layer.statistics, all: count() };
          scene.primitives.remove(layer);
          const left = layer.statistics;
          for (let at = 0; at < 3; at++) stage.frame();
          const { context } = scene as unknown as {
            context: { shaderCache: { destroyReleasedShaderPrograms(): void } };
          };
          context.shaderCache.destroyReleasedShaderPrograms();
          return { during, left, after: count() };
        };
        // What Cesium makes once for picking and the like stays with it.
        const first = await use();
        const second = await use();
        stage.destroy();
        return { first, second };
      }, POSE);
      const { during, left, after } = result.second;
      expect(during.all.Buffer).toBeGreaterThan(after.Buffer!);
      expect(during.all.Program).toBeGreaterThan(after.Program!);
      expect(during.own.gpuObjects.buffers).toBe(during.all.Buffer! - after.Buffer!);
      expect(during.own.gpuObjects.textures).toBe(during.all.Texture! - after.Texture!);
      expect(during.own.gpuObjects.framebuffers).toBe(during.all.Framebuffer! - after.Framebuffer!);
      expect(during.own.gpuObjects.vertexArrays).toBe(during.all.VertexArray! - after.VertexArray!);
      expect(left.gpuBytes).toBe(0);
      expect(Object.values(left.gpuObjects).every((value) => value === 0)).toBe(true);
      expect(after).toEqual(result.first.after);
    });

    it("compiles any set of effects without an error", { timeout: 90_000 }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const { Stage, Cesium, layer: api } = window.page;
        const stage = new Stage({ width: 64, height: 48 });
        const layer = await stage.show("stripes", { maximumScreenSpaceError: 8 });
        stage.look(pose);
        const clips = new api.ClipSet([
          api.Clip.plane({ through: { source: [500_000, 5_200_000, 500] }, mode: "highlight" }),
          api.Clip.box({ center: { source: [500_000, 5_200_000, 500] }, size: [15, 15, 5] }),
        ]);
        const colours = ["rgb", "intensity", "classification", "levelOfDetail", "gpsTime"];
        const sizes = ["fixed", "attenuated", "adaptive"] as const;
        const shapes = ["square", "disc", "paraboloid"] as const;
        const failures: string[] = [];
        let drawn = 0;
        // Every pair of choices comes up at least once.
        for (let at = 0; at < 45; at++) {
          const style = {
            color: colours[at % 5]!,
            size: sizes[Math.floor(at / 5) % 3]!,
            shape: shapes[Math.floor(at / 15) % 3]!,
            pointSize: 6,
            splats: at % 2 === 1,
            eyeDomeLighting:
              at % 3 === 1
                ? { neighbours: at % 4 === 1 ? (4 as const) : (8 as const), strength: 0.4, radius: 1.4 }
                : false,
            opacity: at % 7 === 3 ? 0.5 : 1,
            dithering: at % 4 === 2,
            gamma: at % 5 === 2 ? 1.4 : 1,
            blend: at % 6 === 5 ? { color: "intensity", share: 0.4 } : undefined,
          };
          layer.style = style;
          layer.clips = at % 3 === 0 ? clips : undefined;
          layer.filter =
            at % 4 === 3
              ? { returns: ["first", "intermediate"], ranges: { gpsTime: [3e8, 3.1e8] } }
              : undefined;
          try {
            await stage.settle();
            await layer.pick({ x: 32, y: 24 });
            if (at % 5 === 0) stage.scene.pick(new Cesium.Cartesian2(32, 24));
            const errors = stage.errors();
            if (errors.length > 0) failures.push(`${JSON.stringify(style)}: ${errors}`);
            drawn += layer.statistics.pointsDrawn > 0 ? 1 : 0;
          } catch (thrown) {
            failures.push(`${JSON.stringify(style)}: ${thrown}`.slice(0, 2000));
          }
        }
        const { programs } = layer.statistics.gpuObjects;
        stage.destroy();
        return { failures, drawn, programs };
      }, POSE);
      expect(result.failures).toEqual([]);
      expect(result.drawn).toBe(45);
      // Those of the last picture and its picks, and 24 of former ones at most.
      expect(result.programs).toBeGreaterThan(10);
      expect(result.programs).toBeLessThan(36);
    });
  },
);

import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { colourDifference, meanColour } from "./harness.js";
import type { Pose } from "./stage/setting.js";
import { decode, difference, differenceToExpected, openStage, type StagePage } from "./stage.js";

const GREY = [128, 128, 128];
const OBLIQUE: Pose = { range: 26, pitch: -35, heading: 30 };

describe.skipIf(pythonMissing)(
  `layers in scenes${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage();
    }, 120_000);
    afterAll(() => stage?.close());

    it("are refused in Columbus view and in 2D, with one warning each", { timeout: 30_000 }, async () => {
      const warnings: string[] = [];
      stage.page.on("console", (message) => {
        if (message.type() === "warning" && message.text().includes("3D only")) warnings.push(message.text());
      });
      const drawn = await stage.page.evaluate(async (pose) => {
        const stage = new window.page.Stage({ scene3DOnly: false });
        const layer = await stage.show("steps", { style: { eyeDomeLighting: true } });
        stage.look(pose);
        await stage.settle();
        const drawn = [layer.statistics.pointsDrawn > 0];
        for (const flat of ["morphToColumbusView", "morphTo2D"] as const) {
          stage.scene[flat](0);
          for (let at = 0; at < 3; at++) stage.frame();
          drawn.push(layer.statistics.pointsDrawn > 0);
        }
        stage.scene.morphTo3D(0);
        stage.look(pose);
        await stage.settle();
        drawn.push(layer.statistics.pointsDrawn > 0);
        stage.destroy();
        return drawn;
      }, OBLIQUE);
      expect(drawn).toEqual([true, false, false, true]);
      expect(warnings).toHaveLength(1);
    });

    it("look the same with positions of 8 bytes and of 12, whichever the tolerance asks for", {
      timeout: 30_000,
    }, async () => {
      const drawn = await stage.page.evaluate(
        async (pose) => {
          const stage = new window.page.Stage();
          const seen = [];
          for (const tolerance of [0.001, 1e-5]) {
            // Points with gaps between them, so that each shows where it is.
            const layer = await stage.show("stripes", { style: { pointSize: 1 }, tolerance });
            stage.look(pose);
            await stage.settle();
            const row = (name: string) => layer.ledger.find(({ effect }) => effect === name);
            seen.push({
              picture: stage.picture(),
              bytes: layer.statistics.bytesPerPoint,
              storage: row("storage")?.why,
              metres: row("placing")?.magnitude,
              pixels: row("placingOnScreen")?.magnitude,
            });
          }
          const errors = stage.errors();
          stage.destroy();
          return { seen, errors };
        },
        { ...OBLIQUE, range: 8 },
      );
      expect(drawn.errors).toEqual([]);
      const [steps, floats] = drawn.seen;
      expect([steps!.bytes, floats!.bytes]).toEqual([12, 16]);
      expect(steps!.storage).toMatch(/[1-9]\d* at whole steps \(8 bytes a point\), 0 as float32/);
      expect(floats!.storage).toMatch(/ 0 at whole steps \(8 bytes a point\), [1-9]\d* as float32/);
      for (const { metres, pixels } of drawn.seen) {
        expect(metres).toBeLessThan(1e-4);
        expect(pixels).toBeLessThan(0.05);
      }
      expect(steps!.metres).toBeGreaterThan(floats!.metres!);
      const pictures = drawn.seen.map(({ picture }, at) => decode(picture, `scene-bytes-${at}`));
      // Points that are 0.05 px beside their place show in a few pixels at their edges.
      expect(difference(pictures[0]!, pictures[1]!)).toBeLessThan(0.005);
    });

    it("fill a picture of another size after a resize", { timeout: 30_000 }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const stage = new window.page.Stage();
        const layer = await stage.show("steps", {
          style: { pointSize: 4, color: "elevation", eyeDomeLighting: true },
        });
        stage.look(pose);
        await stage.settle();
        stage.picture();
        const before = layer.statistics.gpuObjects;
        stage.resize(400, 120);
        stage.frame();
        stage.resize(200, 240);
        await stage.settle();
        const picture = stage.picture();
        const after = layer.statistics.gpuObjects;
        const errors = stage.errors();
        stage.destroy();
        return { picture, errors, before, after };
      }, OBLIQUE);
      expect(result.errors).toEqual([]);
      expect({ ...result.after, queries: 0 }).toEqual({ ...result.before, queries: 0 });
      const picture = decode(result.picture, "scene-resized");
      expect([picture.width, picture.height]).toEqual([200, 240]);
      expect(differenceToExpected(picture, "scene-resized")).toBeLessThan(0.01);
    });

    it("hide each other, each with Eye-Dome Lighting of its own", { timeout: 30_000 }, async () => {
      const result = await stage.page.evaluate(async () => {
        const stage = new window.page.Stage();
        const style = { pointSize: 5, eyeDomeLighting: true } as const;
        const low = await stage.show("stripes", { style });
        const high = await stage.add("plane", {
          style: { ...style, opacity: 1 },
          heightOffset: 5,
          clips: [],
        });
        stage.look({ range: 40, pitch: -60 });
        await stage.settle([low, high]);
        const both = stage.picture();
        high.heightOffset = -5;
        await stage.settle([low, high]);
        const below = stage.picture();
        high.show = false;
        await stage.settle([low, high]);
        const alone = stage.picture();
        const errors = stage.errors();
        stage.destroy();
        return { both, below, alone, errors };
      });
      expect(result.errors).toEqual([]);
      const centre = (address: string, name: string) =>
        meanColour(decode(address, `scene-${name}`), 128, 96, 4);
      expect(colourDifference(centre(result.both, "two-above"), GREY)).toBeLessThan(40);
      expect(colourDifference(centre(result.below, "two-below"), [50, 80, 230])).toBeLessThan(40);
      expect(colourDifference(centre(result.alone, "two-alone"), [50, 80, 230])).toBeLessThan(40);
    });

    it("show one scan in two viewers, each in its own way", { timeout: 30_000 }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const { Stage } = window.page;
        const [left, right] = [new Stage(), new Stage()];
        const first = await left.show("steps", { style: { pointSize: 4, color: "elevation" } });
        const second = await right.show("steps", { style: { pointSize: 4, eyeDomeLighting: true } });
        left.look(pose);
        right.look({ ...pose, heading: 200 });
        await left.settle();
        await right.settle();
        await left.settle();
        const pictures = [left.picture(), right.picture()];
        left.destroy();
        // What the other one frees on its GPU is not this one's.
        right.frame();
        const again = right.picture();
        const drawn = [first.statistics.pointsDrawn, second.statistics.pointsDrawn];
        const errors = right.errors();
        right.destroy();
        return { pictures, again, drawn, errors };
      }, OBLIQUE);
      expect(result.errors).toEqual([]);
      expect(result.drawn[0]).toBe(0);
      expect(result.drawn[1]).toBeGreaterThan(0);
      const [left, right] = result.pictures.map((address, at) => decode(address, `scene-viewer-${at}`));
      expect(difference(left!, right!)).toBeGreaterThan(0.1);
      expect(difference(right!, decode(result.again, "scene-viewer-again"))).toBe(0);
    });

    it("move from one scene to another", { timeout: 30_000 }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const { Stage } = window.page;
        const [from, to] = [new Stage(), new Stage()];
        const layer = await from.show("steps", { style: { pointSize: 4, eyeDomeLighting: true } });
        from.look(pose);
        await from.settle();
        const there = from.picture();
        from.scene.primitives.destroyPrimitives = false;
        from.scene.primitives.remove(layer);
        to.layer = layer;
        to.scene.primitives.add(layer);
        to.look(pose);
        await to.settle();
        const here = to.picture();
        const errors = [...from.errors(), ...to.errors()];
        from.destroy();
        to.destroy();
        return { there, here, errors };
      }, OBLIQUE);
      expect(result.errors).toEqual([]);
      expect(difference(decode(result.there, "scene-from"), decode(result.here, "scene-to"))).toBe(0);
    });

    it("link their first program in the first frame that has points, however little time it has", {
      timeout: 30_000,
    }, async () => {
      const linked = await stage.page.evaluate(async (pose) => {
        const stage = new window.page.Stage();
        const layer = await stage.show("steps", { style: { pointSize: 4 } });
        stage.look(pose);
        const { stream } = layer.cloud;
        while (stream.active > 0) await new Promise((done) => setTimeout(done, 5));
        // Programs that draw points: Cesium has others.
        const { gl } = stage;
        const { shaderSource, attachShader, linkProgram } = gl;
        const ofPoints = new Set<unknown>();
        let linked = 0;
        gl.shaderSource = (shader, text) => {
          if (text.includes("gl_PointSize")) ofPoints.add(shader);
          shaderSource.call(gl, shader, text);
        };
        gl.attachShader = (program, shader) => {
          if (ofPoints.has(shader)) ofPoints.add(program);
          attachShader.call(gl, program, shader);
        };
        gl.linkProgram = (program) => {
          if (ofPoints.has(program)) linked++;
          linkProgram.call(gl, program);
        };
        // A machine on which a second passes between two looks at the clock: no frame has time for anything.
        const now = performance.now.bind(performance);
        let looks = 0;
        performance.now = () => now() + 1000 * ++looks;
        try {
          stage.frame();
        } finally {
          performance.now = now;
          stage.destroy();
        }
        return linked;
      }, OBLIQUE);
      expect(linked).toBe(1);
    });

    it("ask for frames until all is drawn, and then for none, where frames come on demand", {
      timeout: 30_000,
    }, async () => {
      const result = await stage.page.evaluate(async (pose) => {
        const stage = new window.page.Stage({ requestRenderMode: true });
        const layer = await stage.show("steps", { style: { pointSize: 4, eyeDomeLighting: true } });
        stage.look(pose);
        let frames = 0;
        stage.scene.postRender.addEventListener(() => void frames++);
        for (let at = 0; at < 200 && !layer.settled; at++) {
          stage.frame();
          await new Promise((done) => setTimeout(done, 10));
        }
        const settled = layer.settled;
        // One frame that was asked for may still come.
        for (let at = 0; at < 3; at++) stage.frame();
        const loading = frames;
        for (let at = 0; at < 20; at++) stage.frame();
        const idle = frames - loading;
        layer.style = { color: "elevation" };
        stage.scene.requestRender();
        for (let at = 0; at < 20; at++) stage.frame();
        const restyled = layer.settled;
        const drawn = frames - loading;
        // By its own rounding, as Cesium does where somebody listens to the camera.
        stage.scene.camera.direction.x += 2e-16;
        const turned = layer.settled;
        const still = frames;
        layer.retryFailed();
        for (let at = 0; at < 5; at++) stage.frame();
        const retried = frames - still;
        stage.destroy();
        return { settled, idle, restyled, drawn, turned, retried };
      }, OBLIQUE);
      expect(result).toMatchObject({ settled: true, idle: 0, restyled: true, turned: true });
      expect(result.retried).toBeGreaterThan(0);
      expect(result.drawn).toBeGreaterThan(0);
      expect(result.drawn).toBeLessThan(10);
    });
  },
);

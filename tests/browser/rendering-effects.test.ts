import type { PNG } from "pngjs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import type { LayerOptions, Pose, StageOptions } from "./stage/setting.js";
import { decode, openStage, type StagePage } from "./stage.js";

/** Background of a stage. */
const BACKGROUND = [24, 28, 40] as const;

describe.skipIf(pythonMissing)(
  `what effects do${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage();
    }, 120_000);
    afterAll(() => stage?.close());

    async function draw(
      name: string,
      scan: string,
      options: LayerOptions,
      pose: Pose,
      setting: StageOptions = {},
    ): Promise<PNG> {
      const { picture, errors } = await stage.page.evaluate(
        async ([scan, options, pose, setting]) => {
          const stage = new window.page.Stage(setting);
          try {
            await stage.show(scan, options);
            stage.look(pose);
            await stage.settle();
            return { picture: stage.picture(), errors: stage.errors() };
          } finally {
            stage.destroy();
          }
        },
        [scan, options, pose, setting] as const,
      );
      expect(errors).toEqual([]);
      return decode(picture, `effect-${name}`);
    }

    it("Eye-Dome Lighting darkens silhouettes", { timeout: 30_000 }, async () => {
      const pose = { range: 40, pitch: -90 };
      const plain = await draw("steps-plain", "steps", { style: { pointSize: 4 } }, pose);
      const lit = await draw("steps-lit", "steps", { style: { pointSize: 4, eyeDomeLighting: true } }, pose);
      const dark = darkened(plain, lit);
      // The block's outline is 4 · 8 m at 20 m · 192 px / (2 · 40 m · tan 30°) = 4.2 px/m; it is a line, not an area.
      expect(dark.length).toBeGreaterThan(100);
      expect(dark.length).toBeLessThan(400);
      // All of it lies around the block, which is 8 m wide and 4 m nearer to the camera.
      const edge = (8 / 2) * pixelsPerMetre(36);
      for (const { x, y } of dark) {
        const distance = Math.max(Math.abs(x - 127.5), Math.abs(y - 95.5));
        expect(Math.abs(distance - edge)).toBeLessThan(4);
      }
    });

    it("Eye-Dome Lighting leaves a plane as it is", { timeout: 30_000 }, async () => {
      const pose = { range: 40, pitch: -90 };
      const plain = await draw("plane-plain", "plane", { style: { pointSize: 4 } }, pose);
      const lit = await draw("plane-lit", "plane", { style: { pointSize: 4, eyeDomeLighting: true } }, pose);
      expect(darkened(plain, lit, 1)).toEqual([]);
    });

    it("blended splats come nearer to a supersampled picture than the nearest points do", {
      timeout: 60_000,
    }, async () => {
      const pose = { range: 7, pitch: -40, heading: 20 };
      const size = { pointSize: 5, shape: "disc" } as const;
      const options = { maximumScreenSpaceError: 1 };
      const nearest = await draw("checks-nearest", "checks", { ...options, style: size }, pose);
      const blended = await draw(
        "checks-splats",
        "checks",
        { ...options, style: { ...size, splats: true } },
        pose,
      );
      const large = { width: 1024, height: 768 };
      const reference = await draw("checks-reference", "checks", { ...options, style: size }, pose, large);
      const truth = shrink(reference, 4);
      const errors = [nearest, blended].map((picture) => rootMeanSquare(picture, truth));
      expect(errors[1]).toBeLessThan(0.6 * errors[0]!);
    });

    it("splats that nothing would show of are not drawn, and the picture stays", {
      timeout: 60_000,
    }, async () => {
      const style = { pointSize: 2, splats: true, color: "elevation" } as const;
      const options = { maximumScreenSpaceError: 0.5, style };
      const pose = { range: 60, pitch: -12, heading: 20 };
      /** @param shader what it is told in place of what says which points are hidden */
      const pictureWith = async (from: string, to: string) => {
        const end = await stage.page.evaluateHandle(
          ([from, to]) => {
            const { shaderSource } = WebGL2RenderingContext.prototype;
            WebGL2RenderingContext.prototype.shaderSource = function (shader, text) {
              shaderSource.call(this, shader, text.replace(from, to));
            };
            return () => {
              WebGL2RenderingContext.prototype.shaderSource = shaderSource;
            };
          },
          [from, to] as const,
        );
        const picture = await draw("steps-narrow", "steps", options, pose);
        await end.evaluate((end) => end());
        return picture;
      };
      const head = "bool hidden(vec3 place) {";
      const asItIs = await pictureWith(head, head);
      const allDrawn = await pictureWith(head, `${head} return false;`);
      const inFront = await pictureWith(
        "w)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);",
        "w)) gl_Position.z = -gl_Position.w;",
      );
      expect(asItIs.data.equals(allDrawn.data)).toBe(true);
      // Drawn before everything else, those that are left out would show.
      expect(asItIs.data.equals(inFront.data)).toBe(false);
    });

    it("adaptive sizes close holes with less overdraw than one size", { timeout: 60_000 }, async () => {
      const pose = { range: 16, pitch: -90 };
      const of = (style: LayerOptions["style"]) => ({ maximumScreenSpaceError: 0.5, style });
      const adaptive = await draw("density-adaptive", "density", of({ size: "adaptive" }), pose);
      const fine = await draw("density-fine", "density", of({ pointSize: 1 }), pose);
      const coarse = await draw("density-coarse", "density", of({ pointSize: 3 }), pose);
      // Points as wide as the sparse half needs close it; those that the dense half needs leave holes in it.
      expect(holes(adaptive)).toBeLessThan(0.002);
      expect(holes(coarse)).toBeLessThan(0.002);
      expect(holes(fine)).toBeGreaterThan(0.2);
      const layers = [await overdraw({ size: "adaptive" }, pose), await overdraw({ pointSize: 3 }, pose)];
      expect(layers[0]).toBeGreaterThan(1);
      expect(layers[0]).toBeLessThan(0.5 * layers[1]!);
    });

    it("one size on the ground closes what is drawn, however little that is", {
      timeout: 60_000,
    }, async () => {
      const pose = { range: 12, pitch: -90 };
      for (const maximumScreenSpaceError of [3, 8]) {
        const of = (style: LayerOptions["style"]) => ({ maximumScreenSpaceError, style });
        const closed = await draw("plane-attenuated", "plane", of({ size: "attenuated" }), pose);
        const open = await draw("plane-open", "plane", of({ pointSize: 1 }), pose);
        expect(holes(closed)).toBeLessThan(0.002);
        expect(holes(open)).toBeGreaterThan(0.5);
      }
    });

    /** Fragments per pixel: each adds one step of 255 to what is there, with no depth test. */
    async function overdraw(style: LayerOptions["style"], pose: Pose): Promise<number> {
      const picture = await stage.page.evaluate(
        async ([style, pose]) => {
          const stage = new window.page.Stage();
          try {
            const { gl, scene } = stage;
            scene.backgroundColor = window.page.Cesium.Color.BLACK;
            window.page.onPoints(gl, (call) => {
              gl.disable(gl.DEPTH_TEST);
              gl.enable(gl.BLEND);
              gl.blendFunc(gl.ONE, gl.ONE);
              call.draw();
              gl.disable(gl.BLEND);
              gl.enable(gl.DEPTH_TEST);
            });
            const classes = { 0: { color: [1 / 255, 1 / 255, 1 / 255] as const } };
            await stage.show("density", {
              maximumScreenSpaceError: 0.5,
              style: { ...style, color: "classification", classes },
            });
            stage.look(pose);
            await stage.settle();
            return stage.picture();
          } finally {
            stage.destroy();
          }
        },
        [style, pose] as const,
      );
      const { data } = decode(picture, "effect-overdraw");
      let sum = 0;
      for (let at = 0; at < data.length; at += 4) sum += data[at]!;
      return sum / (data.length / 4);
    }
  },
);

/** Pixels that a metre across takes at a distance in metres, in a picture 192 px high with a view of 60° across. */
function pixelsPerMetre(distance: number): number {
  return 256 / (2 * distance * Math.tan(Math.PI / 6));
}

/** Pixels that are darker by more than some steps of 255. */
function darkened(before: PNG, after: PNG, steps = 40): { x: number; y: number }[] {
  const found: { x: number; y: number }[] = [];
  for (let at = 0; at < before.data.length; at += 4) {
    if (before.data[at]! - after.data[at]! > steps) {
      const pixel = at / 4;
      found.push({ x: pixel % before.width, y: Math.floor(pixel / before.width) });
    }
  }
  return found;
}

/** Share of the pixels that show the background. */
function holes({ data }: PNG): number {
  let count = 0;
  for (let at = 0; at < data.length; at += 4) {
    if (BACKGROUND.every((value, channel) => Math.abs(data[at + channel]! - value) <= 2)) count++;
  }
  return count / (data.length / 4);
}

/** Each pixel the mean of a square of pixels. */
function shrink(picture: PNG, factor: number): { width: number; data: Float64Array } {
  const width = picture.width / factor;
  const height = picture.height / factor;
  const data = new Float64Array(4 * width * height);
  for (let y = 0; y < picture.height; y++) {
    for (let x = 0; x < picture.width; x++) {
      const to = 4 * (Math.floor(y / factor) * width + Math.floor(x / factor));
      const from = 4 * (y * picture.width + x);
      for (let channel = 0; channel < 4; channel++)
        data[to + channel]! += picture.data[from + channel]! / factor ** 2;
    }
  }
  return { width, data };
}

/** Difference of two pictures where both show points, steps of 255. */
function rootMeanSquare(a: PNG, b: { data: ArrayLike<number> }): number {
  let sum = 0;
  for (let at = 0; at < a.data.length; at += 4) sum += (a.data[at]! - b.data[at]!) ** 2;
  return Math.sqrt(sum / (a.data.length / 4));
}

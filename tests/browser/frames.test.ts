import { Clip } from "@groma/layer";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { MIDDLE } from "./stage/setting.js";
import { decode, difference, openStage, type StagePage } from "./stage.js";

const [EAST, NORTH] = MIDDLE;

/** Half the edge of a square that cuts, metres. */
const HALF = 4;

/** A square of many corners, so that holding a node against it takes several steps. */
const SQUARE = Clip.polygon(
  (
    [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ] as const
  ).flatMap(([x, y], side, all) => {
    const [toX, toY] = all[(side + 1) % 4]!;
    return Array.from({ length: 24 }, (_, at) => {
      const share = at / 24;
      return [EAST + HALF * (x + share * (toX - x)), NORTH + HALF * (y + share * (toY - y))] as const;
    });
  }),
  { coordinates: "source" },
);

/** Background of a stage. */
const BACKGROUND = [24, 28, 40];

/** Width of the pictures, pixels. */
const WIDTH = 256;

/** Pixels from the middle to the square's edge, seen from above from so many metres. */
function reachAt(range: number): number {
  return (HALF * WIDTH) / (2 * range * Math.tan(Math.PI / 6));
}

describe.skipIf(pythonMissing)(
  `changes that take several frames${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage();
      await stage.page.evaluate(() => {
        const clock = performance.now.bind(performance);
        let ahead = 0;
        // A machine on which each look at the clock takes longer than a frame may prepare: one step in each frame.
        Object.assign(window, {
          slow: (work: () => Promise<unknown>) => {
            performance.now = () => {
              ahead += 30;
              return clock() + ahead;
            };
            return work().finally(() => {
              performance.now = () => clock() + ahead;
            });
          },
        });
      });
    }, 120_000);
    afterAll(() => stage?.close());

    it("a clip shows all at once: each frame is the former picture or the new one", {
      timeout: 120_000,
    }, async () => {
      const result = await stage.page.evaluate(
        async ([square]) => {
          const { Stage, layer: api } = window.page;
          const stage = new Stage();
          const options = { style: { pointSize: 3 }, maximumScreenSpaceError: 1 };
          const layer = await stage.show("density", options);
          stage.look({ range: 30 });
          await stage.settle();
          const before = stage.picture();
          const changes: string[][] = [];
          const until = async () => {
            const pictures: string[] = [];
            do {
              pictures.push(stage.picture());
              await new Promise((done) => setTimeout(done));
            } while (!layer.settled && pictures.length < 500);
            changes.push(pictures);
          };
          const { slow } = window as unknown as { slow: (work: () => Promise<unknown>) => Promise<unknown> };
          await slow(async () => {
            layer.clips = new api.ClipSet([square]);
            await until();
            layer.clips.clear();
            await until();
          });
          const settled = layer.settled;
          // The same on a machine that does all in one frame.
          layer.clips = new api.ClipSet([square]);
          await stage.settle();
          const whole = stage.picture();
          const errors = stage.errors();
          stage.destroy();
          return { before, changes, whole, settled, errors };
        },
        [SQUARE] as const,
      );
      expect(result.errors).toEqual([]);
      expect(result.settled).toBe(true);
      const [added, removed] = result.changes as [string[], string[]];
      expect(
        difference(decode(result.before, "frames-before"), decode(result.whole, "frames-whole")),
      ).toBeGreaterThan(0.2);
      const states = (pictures: string[]) =>
        pictures.map((picture) =>
          picture === result.before ? "before" : picture === result.whole ? "cut" : "neither",
        );
      const cutFrom = states(added).indexOf("cut");
      expect(cutFrom).toBeGreaterThan(5);
      expect(states(added)).toEqual([
        ...Array(cutFrom).fill("before"),
        ...Array(added.length - cutFrom).fill("cut"),
      ]);
      const whole = states(removed);
      expect(whole.at(-1)).toBe("before");
      expect(whole).not.toContain("neither");
    });

    it("never draws a point that is cut: not while nodes load, nor while the camera moves or the style changes", {
      timeout: 120_000,
    }, async () => {
      const result = await stage.page.evaluate(
        async ([square]) => {
          const { Stage, layer: api } = window.page;
          const stage = new Stage();
          const { slow } = window as unknown as { slow: (work: () => Promise<unknown>) => Promise<unknown> };
          const frames: { picture: string; range: number; drawn: number }[] = [];
          const draw = async (range: number, count: number) => {
            stage.look({ range });
            for (let at = 0; at < count; at++) {
              const picture = stage.picture();
              frames.push({ picture, range, drawn: stage.layer.statistics.pointsDrawn });
              await new Promise((done) => setTimeout(done));
              if (stage.layer.settled) return;
            }
          };
          await slow(async () => {
            const clips = new api.ClipSet([square]);
            // Another cloud object: nothing of it is loaded.
            const opened = await api.PointCloudLayer.fromUrl("/clouds/density.copc.laz", {
              style: { pointSize: 3 },
              maximumScreenSpaceError: 1,
              clips,
              workers: { size: 1 },
            });
            stage.layer = opened;
            stage.scene.primitives.add(opened);
            await draw(60, 400);
            await draw(40, 100);
            opened.style = { color: "elevation", eyeDomeLighting: true };
            await draw(25, 100);
            await draw(20, 100);
          });
          // What is on the GPU already, was out of sight while the clips were changed, and comes back.
          const { layer } = stage;
          layer.clips = undefined;
          await stage.settle();
          stage.look({ range: 60 });
          await stage.settle();
          layer.clips = new api.ClipSet([square]);
          await stage.settle();
          await slow(() => draw(20, 100));
          const { settled } = layer;
          const errors = stage.errors();
          stage.destroy();
          return { frames, settled, errors };
        },
        [SQUARE] as const,
      );
      expect(result.errors).toEqual([]);
      expect(result.settled).toBe(true);
      expect(result.frames.length).toBeGreaterThan(20);
      // Frames differ in how much is there, or there would be nothing to see.
      expect(new Set(result.frames.map(({ drawn }) => drawn)).size).toBeGreaterThan(3);
      const seen = new Set<string>();
      for (const { picture, range } of result.frames) {
        if (seen.has(picture)) continue;
        seen.add(picture);
        const reach = reachAt(range) + 3;
        const { data, width, height } = decode(picture, "frames-cut");
        let outside = 0;
        for (let at = 0; at < width * height; at++) {
          const [x, y] = [(at % width) + 0.5 - width / 2, Math.floor(at / width) + 0.5 - height / 2];
          if (Math.max(Math.abs(x), Math.abs(y)) <= reach) continue;
          if (BACKGROUND.some((value, channel) => Math.abs(data[4 * at + channel]! - value) > 2)) outside++;
        }
        expect([range, outside]).toEqual([range, 0]);
      }
      const last = decode(result.frames.at(-1)!.picture, "frames-last");
      const middle = 4 * (Math.floor(last.height / 2) * last.width + last.width / 2);
      expect(BACKGROUND.some((value, channel) => Math.abs(last.data[middle + channel]! - value) > 20)).toBe(
        true,
      );
    });

    /** What frames of three styles show, their calls and those of frames that move, where many nodes are drawn by one or not. */
    const frames = (together: boolean) =>
      stage.page.evaluate(async (together) => {
        const { Stage } = window.page;
        const { getSupportedExtensions } = WebGL2RenderingContext.prototype;
        WebGL2RenderingContext.prototype.getSupportedExtensions = function () {
          const names = getSupportedExtensions.call(this);
          return names?.filter((name) => together || name !== "WEBGL_multi_draw") ?? null;
        };
        const stage = new Stage();
        const layer = await stage.show("density", { maximumScreenSpaceError: 0.5 });
        stage.look({ range: 30 });
        const gl = stage.gl as unknown as Record<string, (...given: unknown[]) => unknown>;
        const many = stage.gl.getExtension("WEBGL_multi_draw") as unknown as typeof gl | null;
        const names = Object.keys(Object.getPrototypeOf(gl)).filter((name) =>
          /^(drawArrays|drawElements|uniform\d|uniformMatrix|bufferData|bufferSubData|tex\w*Image)/.test(
            name,
          ),
        );
        /** Calls of a frame that draws nothing anew. */
        const callsOf = () => {
          const calls = { draws: 0, uniforms: 0, writes: 0 };
          const count = (object: typeof gl, name: string) => {
            const own = Object.getPrototypeOf(object)[name];
            object[name] = (...given) => {
              calls[/draw/i.test(name) ? "draws" : /^uniform/.test(name) ? "uniforms" : "writes"]++;
              return own.apply(object, given);
            };
          };
          for (const name of names) count(gl, name);
          if (many) count(many, "multiDrawArraysWEBGL");
          stage.frame();
          for (const name of names) delete gl[name];
          if (many) delete many.multiDrawArraysWEBGL;
          return calls;
        };
        const styles = {
          fixed: { size: "fixed", shape: "square", pointSize: 6 },
          adaptive: { size: "adaptive", shape: "disc", color: "elevation" },
          splats: { splats: true, eyeDomeLighting: true },
        } as const;
        const pictures: string[] = [];
        const counted: Record<string, { nodes: number; still: object; moving: object }> = {};
        const uniforms: number[] = [];
        for (const [name, style] of Object.entries(styles)) {
          layer.style = style;
          await stage.settle();
          pictures.push(stage.picture());
          const nodes = layer.statistics.nodesVisible;
          const shown = callsOf();
          stage.look({ range: 30.5 });
          const moved = callsOf();
          layer.show = false;
          stage.look({ range: 30 });
          stage.frame();
          const hidden = callsOf();
          stage.look({ range: 30.5 });
          const hiddenMoved = callsOf();
          layer.show = true;
          stage.look({ range: 30 });
          await stage.settle();
          const less = (calls: typeof shown, others: typeof shown) => ({
            draws: calls.draws - others.draws,
            uniforms: calls.uniforms - others.uniforms,
            writes: calls.writes - others.writes,
          });
          const { uniforms: set, ...moving } = less(moved, hiddenMoved);
          counted[name] = { nodes, still: less(shown, hidden), moving };
          uniforms.push(set);
        }
        stage.destroy();
        WebGL2RenderingContext.prototype.getSupportedExtensions = getSupportedExtensions;
        return { counted, uniforms, pictures };
      }, together);

    it("a frame has few calls, and is the same where the browser draws no nodes together", {
      timeout: 120_000,
    }, async () => {
      const together = await frames(true);
      const single = await frames(false);
      expect(single.pictures).toEqual(together.pictures);
      expect(new Set(single.pictures).size).toBeGreaterThan(1);
      // Each of the three nodes fills a page of its own here.
      expect(single.counted).toEqual(together.counted);
      // Of Cesium's camera and of passes; with splats 16 and 18 were seen. None is a node's.
      for (const set of [...together.uniforms, ...single.uniforms]) expect(set).toBeLessThanOrEqual(20);
      expect(together.counted).toMatchInlineSnapshot(`
        {
          "adaptive": {
            "moving": {
              "draws": 7,
              "writes": 1,
            },
            "nodes": 3,
            "still": {
              "draws": 7,
              "uniforms": 3,
              "writes": 0,
            },
          },
          "fixed": {
            "moving": {
              "draws": 7,
              "writes": 1,
            },
            "nodes": 3,
            "still": {
              "draws": 7,
              "uniforms": 3,
              "writes": 0,
            },
          },
          "splats": {
            "moving": {
              "draws": 12,
              "writes": 1,
            },
            "nodes": 3,
            "still": {
              "draws": 4,
              "uniforms": 0,
              "writes": 0,
            },
          },
        }
      `);
    });
  },
);

import { Clip } from "@groma/layer";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { MIDDLE, type Pose } from "./stage/setting.js";
import { openStage, type StagePage } from "./stage.js";

/** What a view came to. */
interface Probed {
  readonly magnitude: number;
  readonly active: boolean;
  readonly why: string;
  readonly framebuffers: number;
  readonly fences: number;
  readonly nodes: number;
  /** Draws of points in a frame of a view that has settled. */
  readonly draws: number;
  readonly errors: readonly number[];
}

describe.skipIf(pythonMissing)(
  `silhouettes as they are measured${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage();
    }, 120_000);
    afterAll(() => stage?.close());

    /** Shows a scan in styles one after the other. */
    function show(
      scan: string,
      pose: Pose,
      styles: readonly (boolean | "auto")[],
      orthographic?: number,
    ): Promise<Probed[]> {
      return stage.page.evaluate(
        async ([scan, pose, styles, orthographic]) => {
          const stage = new window.page.Stage();
          try {
            const layer = await stage.show(scan, { style: { color: "rgb", pointSize: 3 } });
            stage.look(pose);
            if (orthographic) stage.orthographic(orthographic);
            const found = [];
            for (const eyeDomeLighting of styles) {
              layer.style = { eyeDomeLighting };
              await stage.settle();
              const { gl } = stage;
              let draws = 0;
              const end = window.page.onPoints(gl, (call) => {
                draws += call.counts.filter((count) => count > 0).length;
                call.draw();
              });
              stage.frame();
              end();
              const { magnitude, active, why } = layer.ledger.find(
                ({ effect }) => effect === "eyeDomeLighting",
              )!;
              const { gpuObjects, nodesLoaded: nodes } = layer.statistics;
              const { framebuffers, fences } = gpuObjects;
              found.push({
                magnitude,
                active,
                why,
                framebuffers,
                fences,
                nodes,
                draws,
                errors: stage.errors(),
              });
            }
            return found;
          } finally {
            stage.destroy();
          }
        },
        [scan, pose, styles, orthographic] as const,
      );
    }

    it("are none on a plane, seen face on and from the side", { timeout: 60_000 }, async () => {
      for (const pitch of [-90, -60]) {
        const [flat] = await show("plane", { range: 24, pitch }, ["auto"]);
        expect(flat!.magnitude).toBeLessThan(0.001);
        expect(flat!.active).toBe(false);
        expect(flat!.why).toContain("measured");
        expect(flat!.errors).toEqual([]);
      }
    });

    it("are there where one level stands above another, and let Eye-Dome Lighting run", {
      timeout: 60_000,
    }, async () => {
      const pose = { range: 26, pitch: -50, heading: 30 };
      const [stepped] = await show("steps", pose, ["auto"]);
      expect(stepped!.magnitude).toBeGreaterThan(0.01);
      expect(stepped!.magnitude).toBeLessThan(0.3);
      expect(stepped!.active).toBe(true);
      expect(stepped!.why).toContain("measured");
      // One to draw the points into, one for the windows.
      expect(stepped!.framebuffers).toBe(2);
      expect(stepped!.errors).toEqual([]);
      const [without] = await show("steps", pose, ["auto"], 30);
      expect(without!.magnitude).toBeGreaterThan(0.01);
    });

    it("are measured again where a clip is moved within the same nodes", { timeout: 60_000 }, async () => {
      const [east, north, up] = MIDDLE;
      // The first cuts air, the second all that stands above the level square.
      const boxes = [40, 3.05].map((above) =>
        Clip.box({ center: { source: [east, north, up + above] }, size: [30, 30, 6], mode: "outside" }),
      );
      const magnitudes = await stage.page.evaluate(async ([air, block]) => {
        const { layer: api, Stage } = window.page;
        const stage = new Stage();
        try {
          const style = { color: "rgb", pointSize: 3, eyeDomeLighting: "auto" } as const;
          const layer = await stage.show("steps", { style });
          stage.look({ range: 26, pitch: -50, heading: 30 });
          const clips = new api.ClipSet([air!]);
          layer.clips = clips;
          const found = [];
          for (const clip of [air!, block!]) {
            clips.replace(air!, clip);
            await stage.settle();
            found.push(layer.ledger.find(({ effect }) => effect === "eyeDomeLighting")!.magnitude);
          }
          return found;
        } finally {
          stage.destroy();
        }
      }, boxes);
      expect(magnitudes[0]).toBeGreaterThan(0.01);
      // What is left of it: the rim of the hole where the block stood.
      expect(magnitudes[1]).toBeLessThan(0.003);
    });

    it("are measured once for a view that rests, and not at all where nobody asks", {
      timeout: 60_000,
    }, async () => {
      const pose = { range: 24, pitch: -90 };
      const [off, auto, again] = await show("plane", pose, [false, "auto", false]);
      expect(off!.framebuffers).toBe(0);
      expect(off!.draws).toBe(off!.nodes);
      expect(auto!.framebuffers).toBe(1);
      expect(auto!.draws).toBe(auto!.nodes);
      expect([off!.fences, auto!.fences, again!.fences]).toEqual([0, 0, 0]);
      expect(again!.framebuffers).toBe(0);
      expect(again!.draws).toBe(again!.nodes);
    });
  },
);

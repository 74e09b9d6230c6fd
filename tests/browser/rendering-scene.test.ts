import type { PNG } from "pngjs";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing } from "../python.js";
import { colourDifference, meanColour } from "./harness.js";
import { type LayerOptions, MIDDLE, type Pose, type StageOptions } from "./stage/setting.js";
import { decode, difference, differenceToExpected, openStage, type StagePage } from "./stage.js";

/** Ways to draw that take different passes. */
const WAYS = {
  direct: { pointSize: 5 },
  "eye-dome": { pointSize: 5, eyeDomeLighting: true },
  splats: { pointSize: 5, splats: true },
} as const satisfies Record<string, LayerOptions["style"]>;

const GREY = [128, 128, 128];
const RED = [255, 0, 0];
const [EAST, NORTH, UP] = MIDDLE;

describe.skipIf(pythonMissing)(
  `points in a scene${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`,
  () => {
    let stage: StagePage;
    beforeAll(async () => {
      stage = await openStage();
    }, 120_000);
    afterAll(() => stage?.close());

    /** What a stage is set with besides the scan. */
    interface Scene extends StageOptions {
      /** Red boxes, by the places of their middles, source coordinates, and their edges, metres. */
      readonly boxes?: readonly { readonly at: readonly [number, number, number]; readonly edge: number }[];
      /** Ratio of far to near at which Cesium cuts the scene into frusta. */
      readonly farToNearRatio?: number;
      readonly depthTestAgainstTerrain?: boolean;
      /** Metres of ground across the picture, without perspective. */
      readonly orthographic?: number;
      /** Degrees of the view across. */
      readonly fieldOfView?: number;
    }

    async function draw(name: string, scan: string, options: LayerOptions, pose: Pose, scene: Scene = {}) {
      const { picture, errors, frusta } = await stage.page.evaluate(
        async ([scan, options, pose, setting]) => {
          const { Cesium, Stage } = window.page;
          const stage = new Stage(setting);
          const { scene } = stage;
          try {
            await stage.show(scan, options);
            for (const { at, edge } of setting.boxes ?? []) stage.box(at, edge);
            if (setting.farToNearRatio) scene.farToNearRatio = setting.farToNearRatio;
            if (scene.globe && setting.depthTestAgainstTerrain !== undefined) {
              scene.globe.depthTestAgainstTerrain = setting.depthTestAgainstTerrain;
            }
            const { frustum } = scene.camera;
            if (setting.fieldOfView && frustum instanceof Cesium.PerspectiveFrustum) {
              frustum.fov = (setting.fieldOfView * Math.PI) / 180;
            }
            stage.look(pose);
            if (setting.orthographic) stage.orthographic(setting.orthographic);
            await stage.settle();
            const picture = stage.picture();
            const { frustumCommandsList } = (scene as unknown as { view: { frustumCommandsList: unknown[] } })
              .view;
            return { picture, errors: stage.errors(), frusta: frustumCommandsList.length };
          } finally {
            stage.destroy();
          }
        },
        [scan, options, pose, scene] as const,
      );
      expect(errors).toEqual([]);
      return { picture: decode(picture, `scene-${name}`), frusta };
    }

    const boxes = [
      { at: [EAST - 5, NORTH, UP + 4], edge: 3 },
      { at: [EAST + 5, NORTH, UP - 4], edge: 3 },
    ] as const;

    it.each(
      Object.entries(WAYS).flatMap(([way, style]) =>
        [true, false].map((logDepth) => ({ way, style, logDepth })),
      ),
    )(
      "$way: hidden by what stands before them and hiding what stands behind them, logarithmic depth $logDepth",
      { timeout: 30_000 },
      async ({ way, style, logDepth }) => {
        const name = `boxes-${way}-${logDepth}`;
        const { picture } = await draw(
          name,
          "plane",
          { style },
          { range: 30 },
          { boxes, logDepth, globe: !logDepth },
        );
        // 256 px over 60° at 26 m and at 34 m.
        const front = meanColour(picture, 128 - (5 * 128) / (26 * Math.tan(Math.PI / 6)), 96, 2);
        const behind = meanColour(picture, 128 + (5 * 128) / (34 * Math.tan(Math.PI / 6)), 96, 2);
        expect(colourDifference(front, RED)).toBeLessThan(8);
        expect(colourDifference(behind, GREY)).toBeLessThan(8);
        // Nothing red shines through anywhere else.
        expect(shareOf(picture, RED, 60)).toBeLessThan(0.03);
      },
    );

    it.each([
      ["eye-dome", WAYS["eye-dome"]],
      ["splats", WAYS.splats],
    ] as const)(
      "%s: points at rest are not drawn again, and hide and are hidden by what moves",
      { timeout: 60_000 },
      async (way, style) => {
        const found = await stage.page.evaluate(
          async ([style, [front, behind]]) => {
            const { Cesium, Stage, onPoints } = window.page;
            const stage = new Stage();
            const layer = await stage.show("plane", { style });
            stage.look({ range: 30 });
            await stage.settle();
            const box = stage.box(front.at, front.edge);
            const [from, to] = [front, behind].map(({ at }) =>
              Cesium.Cartesian3.fromArray([...layer.cloud.place(...at)]),
            );
            const way = Cesium.Cartesian3.subtract(to!, from!, new Cesium.Cartesian3());
            let calls = 0;
            const end = onPoints(stage.gl, (call) => {
              calls++;
              call.draw();
            });
            const rounds = [];
            for (const moved of [Cesium.Cartesian3.ZERO, way]) {
              box.modelMatrix = Cesium.Matrix4.fromTranslation(moved);
              calls = 0;
              const again = stage.picture();
              const still = calls;
              stage.look({ range: 31 });
              stage.frame();
              stage.look({ range: 30 });
              await stage.settle();
              rounds.push({ again, still, moving: calls - still, anew: stage.picture() });
            }
            end();
            const errors = stage.errors();
            stage.destroy();
            return { rounds, errors };
          },
          [style, boxes] as const,
        );
        expect(found.errors).toEqual([]);
        expect(found.rounds.map(({ still }) => still)).toEqual([0, 0]);
        for (const { again, anew, moving } of found.rounds) {
          expect(again === anew).toBe(true);
          expect(moving).toBeGreaterThan(0);
        }
        const [before, after] = found.rounds.map(({ again }, at) => decode(again, `still-${way}-${at}`));
        const middle = (range: number, metres: number) =>
          128 + (metres * 128) / (range * Math.tan(Math.PI / 6));
        expect(colourDifference(meanColour(before!, middle(26, -5), 96, 2), RED)).toBeLessThan(8);
        expect(colourDifference(meanColour(after!, middle(26, -5), 96, 2), GREY)).toBeLessThan(8);
        expect(colourDifference(meanColour(after!, middle(34, 5), 96, 2), GREY)).toBeLessThan(8);
        expect(shareOf(before!, RED, 60)).toBeGreaterThan(0.005);
        expect(shareOf(after!, RED, 60)).toBe(0);
      },
    );

    it.each(Object.entries(WAYS))(
      "%s: the same where frusta cut the cloud",
      { timeout: 30_000 },
      async (way, style) => {
        const pose = { range: 1000, pitch: -20, heading: 30 };
        const options = { style: { ...style, color: "elevation" } };
        const one = await draw(`one-frustum-${way}`, "steps", options, pose, { fieldOfView: 1.6 });
        const setting = { fieldOfView: 1.6, logDepth: false, farToNearRatio: 1.004 };
        const many = await draw(`frusta-${way}`, "steps", options, pose, setting);
        expect(one.frusta).toBe(1);
        expect(many.frusta).toBeGreaterThan(4);
        expect(difference(one.picture, many.picture)).toBeLessThan(0.003);
        expect(1 - shareOf(one.picture, [24, 28, 40], 8)).toBeGreaterThan(0.2);
      },
    );

    it.each(Object.entries(WAYS))(
      "%s: under the globe's surface only where it is asked for",
      {
        timeout: 60_000,
      },
      async (way, style) => {
        const options = { style, heightOffset: -520 };
        const shares: number[] = [];
        for (const depthTestAgainstTerrain of [true, false]) {
          const { picture } = await draw(
            `globe-${way}-${depthTestAgainstTerrain}`,
            "plane",
            options,
            { range: 540 },
            { globe: true, depthTestAgainstTerrain, fieldOfView: 3 },
          );
          shares.push(shareOf(picture, GREY, 8));
        }
        expect(shares[0]).toBe(0);
        expect(shares[1]).toBeGreaterThan(0.15);
      },
    );

    it("the same with 4 samples per pixel", { timeout: 30_000 }, async () => {
      const pose = { range: 26, pitch: -35, heading: 30 };
      const options = { style: { ...WAYS["eye-dome"], color: "elevation" } };
      const one = await draw("msaa-1", "steps", options, pose);
      const four = await draw("msaa-4", "steps", options, pose, { msaa: 4 });
      expect(difference(one.picture, four.picture)).toBeLessThan(0.002);
    });

    it("of one colour in high dynamic range, whatever passes they take", { timeout: 60_000 }, async () => {
      const colours: number[][] = [];
      for (const [way, style] of Object.entries(WAYS)) {
        const { picture } = await draw(
          `hdr-${way}`,
          "plane",
          { style },
          { range: 30 },
          { hdr: true, msaa: 4 },
        );
        colours.push(meanColour(picture, 128, 96, 10));
      }
      expect(colourDifference(colours[1]!, colours[0]!)).toBeLessThan(3);
      expect(colourDifference(colours[2]!, colours[0]!)).toBeLessThan(3);
      // A tone mapper may shift it a little; gamma twice or not at all would take it far away.
      expect(colourDifference(colours[0]!, GREY)).toBeLessThan(25);
    });

    it("without perspective", { timeout: 30_000 }, async () => {
      const pose = { range: 100, pitch: -35, heading: 30 };
      const options = { style: { ...WAYS["eye-dome"], color: "elevation" } };
      const { picture } = await draw("orthographic", "steps", options, pose, { orthographic: 40 });
      expect(differenceToExpected(picture, "scene-orthographic")).toBeLessThan(0.01);
      const adaptive = { style: { size: "adaptive", splats: true, color: "elevation" } } as const;
      const sized = await draw("orthographic-adaptive", "density", adaptive, pose, { orthographic: 40 });
      expect(differenceToExpected(sized.picture, "scene-orthographic-adaptive")).toBeLessThan(0.01);
    });

    it("as large at two pixels per CSS pixel", { timeout: 30_000 }, async () => {
      const pose = { range: 26, pitch: -35, heading: 30 };
      const options = { style: { pointSize: 6, color: "elevation" } } as const;
      const one = await draw("ratio-1", "steps", options, pose);
      const two = await draw("ratio-2", "steps", options, pose, { pixelRatio: 2 });
      expect(two.picture.width).toBe(512);
      const shares = [one, two].map(({ picture }) => shareOf(picture, [24, 28, 40], 8));
      expect(Math.abs(shares[0]! - shares[1]!)).toBeLessThan(0.01);
    });
  },
);

/** Share of pixels that have about one colour. */
function shareOf({ data }: PNG, colour: readonly number[], tolerance: number): number {
  let count = 0;
  for (let at = 0; at < data.length; at += 4) {
    if (colourDifference(data.subarray(at, at + 3), colour) <= tolerance) count++;
  }
  return count / (data.length / 4);
}

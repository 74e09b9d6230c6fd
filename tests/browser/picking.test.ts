import { Clip } from "@groma/layer";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { pythonMissing, runPython } from "../python.js";
import { type LayerOptions, MIDDLE, type Pose, type StageOptions } from "./stage/setting.js";
import { cloudPath, openStage, type StagePage } from "./stage.js";

interface Truth {
  readonly integers: readonly [number, number, number];
  readonly intensity: number;
  readonly classification: number;
  readonly pointSourceId: number;
  readonly gpsTime: number;
}

const [EAST, NORTH, UP] = MIDDLE;

describe.skipIf(pythonMissing)(`picking${pythonMissing ? ` (skipped: ${pythonMissing})` : ""}`, () => {
  let stage: StagePage;
  beforeAll(async () => {
    stage = await openStage();
  }, 120_000);
  afterAll(() => stage?.close());

  it("returns the exact records of 1,000 random drawn points", { timeout: 60_000 }, async () => {
    const { picks, drawn, all, errors } = await stage.page.evaluate(async () => {
      const { Cesium, Stage } = window.page;
      const stage = new Stage({ width: 800, height: 600 });
      try {
        const layer = await stage.show("stripes", { style: { pointSize: 2 }, maximumScreenSpaceError: 0.5 });
        const keys: string[] = [];
        layer.nodeLoaded.addEventListener((key) => void keys.push(key));
        stage.look({ range: 16, pitch: -70, heading: 20 });
        await stage.settle();
        const { cloud } = layer;
        // Every point of the file, with its pixel on the screen; a fixed seed chooses among those that stand alone.
        const points: { node: string; index: number; x: number; y: number }[] = [];
        for (const key of keys) {
          const { positions, order, frame } = await cloud.loadNode(key);
          const { origin, rotation } = frame;
          for (let at = 0; at < order.length; at++) {
            const [east, north, up] = positions.subarray(3 * at, 3 * at + 3) as unknown as [
              number,
              number,
              number,
            ];
            const place = [0, 1, 2].map(
              (axis) =>
                origin[axis]! +
                rotation[axis]! * east +
                rotation[axis + 3]! * north +
                rotation[axis + 6]! * up,
            );
            const pixel = stage.scene.cartesianToCanvasCoordinates(Cesium.Cartesian3.fromArray(place));
            if (pixel) points.push({ node: key, index: order[at]!, x: pixel.x, y: pixel.y });
          }
        }
        const grid = new Map<string, number>();
        const cell = (x: number, y: number) => `${Math.floor(x / 4)},${Math.floor(y / 4)}`;
        for (const { x, y } of points) grid.set(cell(x, y), (grid.get(cell(x, y)) ?? 0) + 1);
        const alone = points.filter(({ x, y }) => {
          const inside = x > 4 && y > 4 && x < 796 && y < 596;
          const middle = Math.abs((x % 4) - 2) < 0.75 && Math.abs((y % 4) - 2) < 0.75;
          return inside && middle && grid.get(cell(x, y)) === 1;
        });
        let seed = 20150217;
        const random = () => {
          seed = (Math.imul(seed, 1_664_525) + 1_013_904_223) >>> 0;
          return seed / 2 ** 32;
        };
        const chosen = Array.from({ length: 1000 }, () => alone[Math.floor(random() * alone.length)]!);
        const picks = [];
        for (let at = 0; at < chosen.length; at += 50) {
          const batch = chosen.slice(at, at + 50).map((point) => layer.pick(point, { window: 1 }));
          picks.push(...(await Promise.all(batch)));
        }
        return {
          picks: picks.map((pick, at) => ({
            wanted: { node: chosen[at]!.node, index: chosen[at]!.index },
            node: pick?.node,
            index: pick?.index,
            integers: pick?.integers,
            attributes: pick?.attributes as Record<string, number> | undefined,
            source: pick?.source,
            away: pick && distance(pick.position, cloud.place(...pick.source)),
          })),
          drawn: layer.statistics.pointsDrawn,
          all: points.length,
          errors: stage.errors(),
        };
      } finally {
        stage.destroy();
      }

      function distance(a: { x: number; y: number; z: number }, b: Float64Array): number {
        return Math.hypot(a.x - b[0]!, a.y - b[1]!, a.z - b[2]!);
      }
    });
    expect(errors).toEqual([]);
    expect(drawn).toBe(all);
    expect(picks).toHaveLength(1000);
    expect(picks.map(({ node, index }) => ({ node, index }))).toEqual(picks.map(({ wanted }) => wanted));
    const asked = picks.map(({ wanted }) => wanted);
    const truth = runPython<Truth[]>("browser/picked.py", [cloudPath("stripes")], JSON.stringify(asked));
    for (const [at, { integers, intensity, classification, pointSourceId, gpsTime }] of truth.entries()) {
      const pick = picks[at]!;
      expect(pick.integers).toEqual(integers);
      expect(pick.attributes).toMatchObject({ intensity, classification, pointSourceId, gpsTime });
      expect(pick.away).toBe(0);
    }
  });

  /** What a pick at places of the canvas finds: heights or undefined. */
  async function pick(
    scan: string,
    options: LayerOptions,
    pose: Pose,
    places: readonly (readonly [number, number])[],
    edge?: number,
    setting: StageOptions = {},
  ) {
    const found = await stage.page.evaluate(
      async ([scan, options, pose, places, edge, setting]) => {
        const stage = new window.page.Stage(setting);
        try {
          const layer = await stage.show(scan, options);
          stage.look(pose);
          await stage.settle();
          const picks = await Promise.all(places.map(([x, y]) => layer.pick({ x, y }, { window: edge })));
          const errors = stage.errors();
          return {
            errors,
            picks: picks.map((pick) => pick && { source: pick.source, node: pick.node, index: pick.index }),
          };
        } finally {
          stage.destroy();
        }
      },
      [scan, options, pose, places, edge, setting] as const,
    );
    expect(found.errors).toEqual([]);
    return found.picks;
  }

  it("finds what is drawn in front, and what is behind once that is cut or filtered away", {
    timeout: 30_000,
  }, async () => {
    const pose = { range: 30, pitch: -90 };
    const middle = [[128, 96]] as const;
    const style = { pointSize: 6 };
    const [front] = await pick("cliff", { style }, pose, middle);
    expect(front?.source[2]).toBe(UP + 6);
    const upper = Clip.box({ center: { source: [EAST, NORTH, UP + 6] }, size: [30, 30, 4], mode: "outside" });
    const [cut] = await pick("cliff", { style, clips: [upper] }, pose, middle);
    expect(cut?.source[2]).toBe(UP);
    const [filtered] = await pick(
      "cliff",
      { style, filter: { ranges: { elevation: [UP - 1, UP + 1] } } },
      pose,
      middle,
    );
    expect(filtered?.source[2]).toBe(UP);
    const [hidden] = await pick("cliff", { style, filter: { classes: [2] } }, pose, middle);
    expect(hidden).toBeUndefined();
  });

  it("finds points as large and as round as they are drawn", { timeout: 30_000 }, async () => {
    // The points lie 10 cm apart, 44 px; the one nearest to the middle lies 5 cm to the east and to the north of it.
    const pose = { range: 0.5, pitch: -90 };
    const perMetre = 256 / (2 * 0.5 * Math.tan(Math.PI / 6));
    const [x, y] = [128 + 0.05 * perMetre, 96 - 0.05 * perMetre];
    const near = [
      [x, y],
      [x + 8, y],
      [x + 8, y + 8],
    ] as const;
    const here = (found: unknown[]) => found.map((point) => point !== undefined);
    const of = (style: LayerOptions["style"]) => pick("stripes", { style }, pose, near, 1);
    expect(here(await of({ pointSize: 4 }))).toEqual([true, false, false]);
    expect(here(await of({ pointSize: 20 }))).toEqual([true, true, true]);
    expect(here(await of({ pointSize: 20, shape: "disc" }))).toEqual([true, true, false]);
    const wide = await pick("stripes", { style: { pointSize: 4 } }, pose, near, 31);
    expect(here(wide)).toEqual([true, true, true]);
    expect(new Set(wide.map((point) => point?.index)).size).toBe(1);
  });

  it.each<[string, LayerOptions["style"], StageOptions]>([
    ["with Eye-Dome Lighting", { pointSize: 3, eyeDomeLighting: true }, {}],
    ["with blended splats", { pointSize: 3, shape: "disc", splats: true }, {}],
    ["translucent", { pointSize: 3, opacity: 0.5 }, {}],
    ["without logarithmic depth", { pointSize: 3 }, { logDepth: false }],
    ["with two pixels per CSS pixel", { pointSize: 3 }, { pixelRatio: 2 }],
  ])("%s finds the same points", { timeout: 30_000 }, async (_name, style, setting) => {
    const pose = { range: 26, pitch: -35, heading: 30 };
    const places = Array.from({ length: 30 }, (_, at) => [60 + 5 * at, 80 + 2 * at] as const);
    const plain = await pick("steps", { style: { pointSize: 3 } }, pose, places, 5);
    const found = await pick("steps", { style }, pose, places, 5, setting);
    const same = found.filter((point, at) => {
      const other = plain[at];
      if (!point || !other) return point === other;
      return Math.hypot(...point.source.map((value, axis) => value - other.source[axis]!)) < 0.35;
    });
    expect(plain.filter((point) => point !== undefined).length).toBeGreaterThan(20);
    expect(same.length).toBeGreaterThanOrEqual(29);
  });

  it("works beside scene.pick, many at once, and never waits for the GPU", { timeout: 30_000 }, async () => {
    const result = await stage.page.evaluate(async () => {
      const { Cesium, Stage } = window.page;
      const stage = new Stage();
      try {
        const layer = await stage.show("stripes", { style: { pointSize: 4 }, id: "mine" });
        stage.look({ range: 26 });
        await stage.settle();
        const { gl, scene } = stage;
        const waits: string[] = [];
        const readPixels = gl.readPixels.bind(gl) as (...args: unknown[]) => void;
        gl.readPixels = (...args: unknown[]) => {
          if (typeof args[6] === "object") waits.push("readPixels");
          readPixels(...args);
        };
        gl.finish = () => void waits.push("finish");
        const picks = Array.from({ length: 40 }, (_, at) => layer.pick({ x: 40 + 4 * at, y: 96 }));
        const waited = [...waits];
        const controller = new AbortController();
        const stopped = layer.pick({ x: 128, y: 96 }, { signal: controller.signal });
        controller.abort(new Error("enough"));
        const found = await Promise.all(picks);
        const beside = scene.pick(new Cesium.Cartesian2(128, 96));
        const nothing = await layer.pick({ x: 3, y: 3 });
        const last = layer.pick({ x: 128, y: 96 });
        stage.frame();
        return {
          waited,
          stopped: await stopped.catch((thrown: Error) => thrown.message),
          found: found.filter((pick) => pick?.layer === layer).length,
          beside: beside?.primitive === layer && beside.id,
          nothing: nothing === undefined,
          last: (await last)?.node,
          left: layer.statistics.gpuObjects.fences,
          errors: stage.errors(),
        };
      } finally {
        stage.destroy();
      }
    });
    expect(result).toMatchObject({
      waited: [],
      stopped: "enough",
      found: 40,
      beside: "mine",
      nothing: true,
      left: 0,
      errors: [],
    });
    expect(result.last).toBeDefined();
  });
});

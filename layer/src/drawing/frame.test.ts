import { describe, expect, it, vi } from "vitest";
import { Clip, ClipSet } from "../clips/index.js";
import type { PointCloud } from "../cloud/index.js";
import { defaultStyle } from "../effects/index.js";
import { SharedBudget } from "../octree/index.js";
import { CostMeter } from "./cost-meter.js";
import { type FrameReport, LayerFrames, type LayerSettings } from "./frame.js";
import { cameraOver, POINTS, TestRenderer, type TestView, testCloud } from "./view.fixture.js";

const turn = () => new Promise((resolve) => setTimeout(resolve));

function settingsOf(parts: Partial<LayerSettings> = {}): LayerSettings {
  return {
    ...{ maximumScreenSpaceError: 2, pointBudget: 1e6, budget: undefined, clips: new ClipSet() },
    ...{ style: defaultStyle({ attributes: [] }), filter: undefined, forced: {} },
    ...parts,
  };
}

async function setUp() {
  const cloud = await testCloud();
  const frames = new LayerFrames<TestView>(cloud, {});
  const renderer = new TestRenderer();
  const frame = (settings: LayerSettings) => frames.draw(settings, cameraOver(cloud, 100), () => renderer);
  /** Frames until one shows all, with time for what is loaded in between. */
  const settle = async (settings: LayerSettings) => {
    for (let left = 200; left > 0; left--) {
      const report = frame(settings);
      if (typeof report !== "string" && report.done) return report;
      await turn();
    }
    throw new Error("does not settle");
  };
  return { cloud, frames, renderer, frame, settle };
}

describe("LayerFrames, in a view of no library at all", () => {
  it("ends the first frames after the first run of each part where that takes long, then draws what is here", async () => {
    const { frame, settle, renderer, frames } = await setUp();
    const settings = settingsOf();
    let now = 0;
    const clock = vi.spyOn(performance, "now").mockImplementation(() => (now += 10));
    expect([frame(settings), frame(settings), frame(settings)]).toEqual(Array(3).fill("unfinished"));
    clock.mockRestore();
    expect(renderer.drawn).toEqual([]);
    const report: FrameReport = await settle(settings);
    expect(report.progress).toEqual({ wanted: 1, ready: 1, failed: 0, pending: 0 });
    expect(renderer.drawn.at(-1)).toBe(POINTS);
    expect([frames.settled(true), frames.limited]).toEqual([true, false]);
    expect(frames.ledger(renderer.content.material?.plan.active).some(({ active }) => active)).toBe(true);
  });

  it("ends none early once it has rehearsed, which asks for the root and shows nothing", async () => {
    const { cloud, frame, frames } = await setUp();
    const settings = settingsOf();
    const clock = vi.spyOn(performance, "now").mockImplementation(() => Number(clock.mock.calls.length) * 10);
    frames.rehearse(settings);
    expect(cloud.stream.active).toBe(1);
    expect([frames.ledger(), frames.settled(true)]).toEqual([[], false]);
    expect(frame(settings)).not.toBe("unfinished");
    clock.mockRestore();
  });

  it("draws its first frame with what is here, where that takes no time", async () => {
    const { cloud, frame, renderer } = await setUp();
    const settings = settingsOf();
    const clock = vi.spyOn(performance, "now").mockReturnValue(0);
    const other = new LayerFrames<TestView>(cloud, {});
    await cloud.loadNode("0-0-0-0");
    expect(other.draw(settings, cameraOver(cloud, 100), () => new TestRenderer())).not.toBe("unfinished");
    expect(frame(settings)).not.toBe("unfinished");
    clock.mockRestore();
    expect(renderer.drawn).toHaveLength(1);
  });

  it("says of the nodes to be drawn how far away they begin", async () => {
    const { cloud, frames, settle, renderer } = await setUp();
    await settle(settingsOf());
    const prepare = vi.spyOn(renderer.content, "prepare");
    const { x, y, z, radius } = cloud.bounds;
    for (const metres of [3000, 20]) {
      const camera = cameraOver(cloud, metres);
      frames.draw(settingsOf(), camera, () => renderer);
      const { position } = camera.view;
      const away = Math.hypot(x - position[0]!, y - position[1]!, z - position[2]!);
      const nearest = prepare.mock.lastCall![0].nearest![0]!;
      expect(nearest).toBeCloseTo(Math.max(camera.near, away - radius), 3);
    }
  });

  it("finds out nothing anew for a view that stands still, until something that it rests on changes", async () => {
    const { cloud, frames, frame, settle, renderer } = await setUp();
    const settings = settingsOf();
    await settle(settings);
    const prepare = vi.spyOn(renderer.content, "prepare");
    /** Whether a frame went through all of its parts. */
    const whole = (given: LayerSettings, metres = 100) => {
      prepare.mockClear();
      const report = frames.draw(given, cameraOver(cloud, metres), () => renderer);
      expect(report).toMatchObject({ done: true });
      expect(renderer.drawn.at(-1)).toBe(POINTS);
      return prepare.mock.calls.length > 0;
    };
    expect(whole(settings)).toBe(false);
    expect(frames.settled(true)).toBe(true);
    const budget = new SharedBudget({ points: 1000 });
    const changes: Record<string, () => boolean> = {
      "the camera": () => whole(settings, 101),
      "a setting": () => whole({ ...settings, maximumScreenSpaceError: 3 }),
      "the stream": () => {
        cloud.stream.retryFailed();
        return whole(settings);
      },
      "the places": () => {
        renderer.content.lift(5);
        return whole(settings);
      },
      "a budget": () => whole({ ...settings, budget }),
      "its size": () => {
        budget.points = 2000;
        return whole({ ...settings, budget });
      },
    };
    for (const [name, change] of Object.entries(changes)) {
      expect(change(), name).toBe(true);
      whole(settings);
      expect(whole(settings), `${name}, still again`).toBe(false);
    }
    const shared = { ...settings, budget };
    whole(shared);
    expect(whole(shared)).toBe(false);
    budget.gpu.report({}, 2 ** 40);
    expect(whole(shared), "another layer takes more than there is").toBe(true);
    frames.rest(true);
    await turn();
    expect(frame(settings)).not.toBe("blocked");
    expect(prepare).toHaveBeenCalled();
  });

  it("takes no frame that only shows a picture again for one that draws", async () => {
    const { cloud, frames, settle, renderer } = await setUp();
    const settings = settingsOf();
    await settle(settings);
    const note = vi.spyOn(CostMeter.prototype, "note");
    let now = performance.now();
    const clock = vi.spyOn(performance, "now").mockImplementation(() => now);
    /** Milliseconds that are noted when the next frame begins, some after this one. */
    const noted = (pictured: boolean, lasts: number) => {
      renderer.pictured = pictured;
      note.mockClear();
      frames.draw(settings, cameraOver(cloud, 100), () => renderer);
      now += lasts;
      return note.mock.calls.map(([{ milliseconds }]) => milliseconds);
    };
    noted(false, 40);
    expect(noted(true, 10)).toEqual([40]);
    expect(noted(true, 10)).toEqual([]);
    expect(noted(false, 40)).toEqual([]);
    expect(noted(false, 40)).toEqual([40]);
    clock.mockRestore();
    note.mockRestore();
  });

  it("draws what volumes leave, and rests where the first ones cannot be prepared", async () => {
    const { cloud, frame, settle, renderer, frames } = await setUp();
    await settle(settingsOf());
    const cut = new ClipSet([boxAt(cloud, "outside")]);
    await settle(settingsOf({ clips: cut }));
    expect(renderer.drawn.at(-1)).toBe(0);
    const placeless = new ClipSet([Clip.box({ center: { source: [1e300, 1e300, 1e300] }, size: [1, 1, 1] })]);
    expect(frame(settingsOf({ clips: placeless }))).not.toBe("blocked");
    expect(frames.takeFailure()).toMatchObject({ code: "STYLE_CLIP" });
    const others = new LayerFrames<TestView>(cloud, {});
    const blocked = settingsOf({ clips: placeless });
    expect(others.draw(blocked, cameraOver(cloud, 100), () => renderer)).toBe("blocked");
  });

  it("keeps a bounded number of GPU objects whatever was shown, and frees all", async () => {
    const { settle, renderer } = await setUp();
    for (let at = 0; at < 100; at++) {
      const ranges = { [["elevation", "intensity"][at % 2]]: [at, 1e6] } as const;
      const style = { ...defaultStyle({ attributes: [] }), gamma: at % 3 ? 1 : 1.5, pointSize: 1 + (at % 7) };
      await settle(settingsOf({ style, filter: at % 5 ? { ranges } : undefined }));
    }
    const { buffers, vertexArrays, programs } = renderer.gpu.counts;
    expect([buffers, vertexArrays]).toEqual([1, 1]);
    expect(programs).toBeLessThan(30);
    renderer.content.destroy();
    expect(Object.values(renderer.gpu.counts).every((count) => count === 0)).toBe(true);
  });

  it("wants nothing any more once it rests", async () => {
    const { cloud, settle, renderer, frames } = await setUp();
    await settle(settingsOf());
    renderer.content.rest();
    frames.rest(false);
    expect([frames.progress.wanted, frames.limited, frames.settled(false)]).toEqual([0, false, true]);
    expect(cloud.stream.active).toBe(0);
  });
});

function boxAt({ bounds: { x, y, z } }: PointCloud, mode: "inside" | "outside"): Clip {
  const height = Math.hypot(x, y);
  const place = { longitude: Math.atan2(y, x), latitude: Math.atan2(z, 0.9933056 * height), height: 0 };
  return Clip.box({ center: place, size: [1e5, 1e5, 1e5], mode });
}

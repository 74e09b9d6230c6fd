import { Cartesian3, PerspectiveFrustum, SceneMode } from "cesium";
import { describe, expect, it, vi } from "vitest";
import { Clip, ClipSet } from "../clips/index.js";
import { PointCloud } from "../cloud/index.js";
import { SharedBudget } from "../octree/index.js";
import { tinyCopc } from "../sources/copc/tiny-copc.fixture.js";
import { BlobSource, type ByteSource } from "../sources/index.js";
import type { NodeExecutor } from "../workers/index.js";
import { PointCloudLayer } from "./point-cloud-layer.js";

const executor = { addDataSet: () => 1, removeDataSet: () => undefined } as unknown as NodeExecutor;

async function open(): Promise<PointCloud> {
  const source = new BlobSource(new Blob([tinyCopc().slice()]), "tiny.copc.laz");
  const crs = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";
  return PointCloud.fromUrl(source, { executor, crs, vertical: "ellipsoidal" });
}

describe("PointCloudLayer.heightOffset", () => {
  it("moves what is flown to, and nothing that is told of the points", async () => {
    const cloud = await open();
    const before = { place: cloud.place(20, 30, 40), accuracy: cloud.accuracy, bounds: { ...cloud.bounds } };
    const layer = PointCloudLayer.fromCloud(cloud, { heightOffset: 5 });
    const { center } = layer.boundingSphere;
    const at = [center.x, center.y, center.z];
    layer.heightOffset = 105;
    expect(Math.hypot(center.x - at[0], center.y - at[1], center.z - at[2])).toBeCloseTo(100, 6);
    expect({ place: cloud.place(20, 30, 40), accuracy: cloud.accuracy, bounds: cloud.bounds }).toEqual(
      before,
    );
    layer.heightOffset = 0;
    const { x, y, z } = cloud.bounds;
    expect([center.x, center.y, center.z]).toEqual([x, y, z]);
  });

  it("goes up", async () => {
    const cloud = await open();
    const layer = PointCloudLayer.fromCloud(cloud, { heightOffset: 1000 });
    const { center } = layer.boundingSphere;
    const { x, y, z } = cloud.bounds;
    expect(Math.hypot(center.x, center.y, center.z)).toBeGreaterThan(Math.hypot(x, y, z) + 990);
  });

  it("STYLE_HEIGHT_OFFSET for what is no length, and stays as it was", async () => {
    const layer = PointCloudLayer.fromCloud(await open(), { heightOffset: 3 });
    expect(() => {
      layer.heightOffset = Number.NaN;
    }).toThrow(expect.objectContaining({ code: "STYLE_HEIGHT_OFFSET" }));
    expect(layer.heightOffset).toBe(3);
  });
});

/** A frame that looks along x and shows nothing, with what is called after it. */
function frame() {
  const afterRender: (() => boolean | undefined)[] = [];
  const frameState = {
    mode: SceneMode.SCENE3D,
    passes: { render: true, pick: false, depth: false },
    context: { _gl: { isContextLost: () => false }, drawingBufferWidth: 100, drawingBufferHeight: 100 },
    camera: {
      positionWC: new Cartesian3(7e6, 0, 0),
      directionWC: Cartesian3.UNIT_X,
      upWC: Cartesian3.UNIT_Z,
      frustum: new PerspectiveFrustum({ fov: 1, aspectRatio: 1, near: 1, far: 10 }),
    },
    cullingVolume: { planes: [] },
    occluder: undefined,
    afterRender,
  };
  return { frameState: frameState as never, after: () => afterRender.map((call) => call()) };
}

describe("PointCloudLayer, before its first frame", () => {
  it("has the root's points on their way, unless it is hidden", async () => {
    const cloud = await open();
    PointCloudLayer.fromCloud(cloud, { show: false });
    expect(cloud.stream.active).toBe(0);
    PointCloudLayer.fromCloud(cloud);
    expect(cloud.stream.active).toBe(1);
    cloud.destroy();
  });
});

describe("PointCloudLayer.update", () => {
  it("never throws: what failed is told once after the frame, and the layer goes on when it can", async () => {
    const layer = PointCloudLayer.fromCloud(await open());
    const told: Error[] = [];
    layer.error.addEventListener((error) => told.push(error));
    const update = () => {
      const { frameState, after } = frame();
      layer.update(frameState);
      const before = told.length;
      after();
      return before;
    };
    layer.budget = Object.assign(new SharedBudget(), { grant: undefined }) as never;
    expect(update()).toBe(0);
    expect(told).toEqual([expect.objectContaining({ name: "DrawError", code: "DRAW_FRAME" })]);
    update();
    expect(told).toHaveLength(1);
    layer.budget = undefined;
    // A frame whose time is over ends with the selection, before it needs the graphics card.
    let now = 0;
    const clock = vi.spyOn(performance, "now").mockImplementation(() => (now += 10));
    update();
    clock.mockRestore();
    expect(told).toHaveLength(1);
    layer.destroy();
  });

  it("draws nothing where its volumes have no place in the data set, and says why", async () => {
    const layer = PointCloudLayer.fromCloud(await open());
    const told: Error[] = [];
    layer.error.addEventListener((error) => told.push(error));
    const impossible = Clip.box({ center: { source: [1e300, 1e300, 1e300] }, size: [1, 1, 1] });
    layer.clips.add(impossible);
    const { frameState, after } = frame();
    layer.update(frameState);
    expect(() => after()).not.toThrow();
    expect([layer.settled, layer.statistics.pointsDrawn, told.length]).toEqual([true, 0, 1]);
    layer.destroy();
  });

  it("does not let a listener end the render loop", async () => {
    const layer = PointCloudLayer.fromCloud(await open());
    const reported: unknown[] = [];
    vi.stubGlobal("reportError", (error: unknown) => reported.push(error));
    layer.error.addEventListener(() => {
      throw new Error("of the application");
    });
    layer.budget = Object.assign(new SharedBudget(), { grant: undefined }) as never;
    const { frameState, after } = frame();
    layer.update(frameState);
    expect(() => after()).not.toThrow();
    expect(reported).toEqual([new Error("of the application")]);
    vi.unstubAllGlobals();
    layer.budget = undefined;
    layer.destroy();
  });
});

describe("PointCloudLayer.clips", () => {
  it("is an empty set from the start, and one again where undefined is assigned", async () => {
    const layer = PointCloudLayer.fromCloud(await open());
    const { clips } = layer;
    expect(clips.size).toBe(0);
    const set = new ClipSet();
    layer.clips = set;
    expect(layer.clips).toBe(set);
    layer.clips = undefined;
    expect([layer.clips.size, layer.clips === set]).toEqual([0, false]);
  });
});

describe("PointCloudLayer.destroy", () => {
  it("ends picks that are on their way", async () => {
    const layer = PointCloudLayer.fromCloud(await open());
    const picks = [layer.pick({ x: 1, y: 1 }), layer.pickPosition({ x: 1, y: 1 })];
    layer.destroy();
    const aborted = expect.objectContaining({ name: "AbortError" });
    for (const pick of picks) await expect(pick).rejects.toEqual(aborted);
  });

  it("may be called again, but nothing else works after it, in Cesium's words", async () => {
    const layer = PointCloudLayer.fromCloud(await open());
    layer.destroy();
    expect([layer.destroy(), layer.isDestroyed()]).toEqual([undefined, true]);
    const destroyed = expect.objectContaining({
      name: "DeveloperError",
      message: "This object was destroyed, i.e., destroy() was called.",
    });
    await expect(layer.pick({ x: 1, y: 1 })).rejects.toEqual(destroyed);
    const uses: (() => void)[] = [
      () => layer.retryFailed(),
      () => {
        layer.style = {};
      },
      () => {
        layer.filter = undefined;
      },
      () => {
        layer.clips = undefined;
      },
      () => {
        layer.heightOffset = 1;
      },
      () => {
        layer.show = false;
      },
      () => {
        layer.maximumScreenSpaceError = 1;
      },
      () => {
        layer.pointBudget = 1;
      },
      () => {
        layer.budget = undefined;
      },
      () => {
        layer.forced = {};
      },
    ];
    for (const use of uses) expect(use).toThrow(destroyed);
    const { frameState } = frame();
    expect(() => layer.update(frameState)).not.toThrow();
  });
});

describe("PointCloudLayer.fromUrl", () => {
  const bytes = tinyCopc().slice();
  const crs = "+proj=utm +zone=32 +ellps=WGS84 +towgs84=0,0,0,0,0,0,0 +units=m";

  /** A source that is told before each read. */
  function watched(beforeRead: () => void): ByteSource {
    return {
      name: "tiny.copc.laz",
      size: bytes.length,
      read: async (begin, end) => {
        beforeRead();
        return bytes.subarray(begin, end);
      },
    };
  }

  it("rejects with the signal's reason, whatever it is and during whichever read it comes", async () => {
    let reads = 0;
    const whole = await PointCloudLayer.fromUrl(
      watched(() => reads++),
      { executor, crs },
    );
    whole.destroy();
    expect(reads).toBeGreaterThan(1);
    for (let abortedRead = 1; abortedRead <= reads; abortedRead++) {
      const control = new AbortController();
      const reason = { of: "the application" };
      let read = 0;
      const source = watched(() => {
        if (++read !== abortedRead) return;
        control.abort(reason);
        throw new Error("what an interrupted read came to");
      });
      const opening = PointCloudLayer.fromUrl(source, { executor, crs, signal: control.signal });
      await expect(opening).rejects.toBe(reason);
    }
    const never = PointCloudLayer.fromUrl(
      watched(() => undefined),
      { executor, crs, signal: AbortSignal.abort("before") },
    );
    await expect(never).rejects.toBe("before");
  });
});

describe("options", () => {
  const refused = (text: string) =>
    expect.objectContaining({
      name: "StyleError",
      code: "STYLE_OPTION",
      message: expect.stringContaining(text),
    });

  it.each<[object, string]>([
    [{ pointBudget: Number.NaN }, "options.pointBudget cannot be NaN. Use a number from 0 on"],
    [{ maximumScreenSpaceError: -1 }, "options.maximumScreenSpaceError cannot be -1"],
    [{ show: "yes" }, "options.show cannot be"],
    [{ clips: [] }, "Use a ClipSet"],
    [{ budget: { points: 1 } }, "Use a SharedBudget"],
    [{ poinBudget: 1 }, 'options has no "poinBudget". Did you mean "pointBudget"'],
    [JSON.parse('{ "__proto__": 1 }'), 'options has no "__proto__"'],
    [{ constructor: 1 }, 'options has no "constructor"'],
    [{ toString: 1 }, 'options has no "toString"'],
  ])("%o is refused before anything is read, and for an open cloud", async (options, text) => {
    let reads = 0;
    const read = async () => {
      reads++;
      return new Uint8Array();
    };
    const source: ByteSource = { name: "a", size: 1, read };
    await expect(PointCloudLayer.fromUrl(source, options)).rejects.toEqual(refused(text));
    expect(reads).toBe(0);
    const cloud = await open();
    expect(() => PointCloudLayer.fromCloud(cloud, options)).toThrow(refused(text));
  });

  it.each<[object, string]>([
    [{ timeout: "5" }, "options.timeout cannot be"],
    [{ timeout: Number.POSITIVE_INFINITY }, "options.timeout cannot be Infinity"],
    [{ tolerance: Number.NaN }, "options.tolerance cannot be NaN"],
    [{ tolerance: 0 }, "options.tolerance cannot be 0. Use a number greater than 0"],
    [{ crs: 2056 }, "options.crs cannot be 2056. Use a string"],
    [{ credentials: "included" }, 'Did you mean "include"'],
    [{ retry: { attemps: 2 } }, 'options.retry has no "attemps"'],
    [{ limits: { requests: 0 } }, "options.limits.requests cannot be 0"],
    [{ headers: "a" }, "options.headers cannot be"],
    [{ signal: {} }, "Use an AbortSignal"],
    [{ executor: {} }, "options.executor cannot be an object"],
    [{ constructor: 1 }, 'options has no "constructor"'],
  ])("%o is refused for a data set", async (options, text) => {
    await expect(PointCloud.fromUrl(new Blob(), options)).rejects.toEqual(refused(text));
    await expect(PointCloudLayer.fromUrl(new Blob(), options)).rejects.toEqual(refused(text));
  });

  it.each([{}, undefined, "site.copc.laz"])("%o is no data set to make a layer of", (cloud) => {
    expect(() => PointCloudLayer.fromCloud(cloud as never)).toThrow(refused("Use a PointCloud"));
  });

  it.each([
    [undefined, "undefined: there is no address"],
    [5, "5: there is no address"],
    ["  ", "there is no address"],
    ["javascript:alert(1)", "addresses with javascript: cannot be read"],
    ["C:\\scans\\a.laz", "addresses with c: cannot be read"],
    [new URL("ftp://example.org/a.laz"), "addresses with ftp: cannot be read"],
  ])("%o is refused as an address, before any request", async (from, text) => {
    const fetching = vi.spyOn(globalThis, "fetch");
    await expect(PointCloud.fromUrl(from as never)).rejects.toThrow(
      expect.objectContaining({ code: "SOURCE_ADDRESS", message: expect.stringContaining(text) }),
    );
    expect(fetching).not.toHaveBeenCalled();
    fetching.mockRestore();
  });

  it.each(["show", "maximumScreenSpaceError", "pointBudget", "budget", "clips"] as const)(
    "%s is refused when assigned, and stays as it was",
    async (name) => {
      const layer = PointCloudLayer.fromCloud(await open());
      const before = layer[name];
      for (const value of [Number.NaN, -1, "1", null, {}]) {
        expect(() => Object.assign(layer, { [name]: value })).toThrow(refused(`${name} cannot be`));
      }
      expect(layer[name]).toBe(before);
    },
  );

  it("budget and clips may come from another copy of the library", async () => {
    vi.resetModules();
    const copy = await import("../index.js");
    expect(copy.SharedBudget).not.toBe(SharedBudget);
    const [budget, clips] = [new copy.SharedBudget({ points: 5 }), new copy.ClipSet()];
    clips.add(copy.Clip.plane({ through: { source: [0, 0, 0] } }));
    const layer = PointCloudLayer.fromCloud(await open(), { budget: budget as never, clips: clips as never });
    const { frameState, after } = frame();
    layer.update(frameState);
    after();
    expect([layer.budget, layer.clips, layer.clips.cutting]).toEqual([budget, clips, 1]);
    expect(budget.granted).toBeLessThanOrEqual(5);
  });

  it.each<[unknown, unknown, string]>([
    [{ x: Number.NaN, y: 1 }, {}, "windowPosition cannot be an object. Use finite numbers x and y"],
    [{ x: 1 }, {}, "windowPosition cannot be"],
    [[1, 2], {}, "windowPosition cannot be an array of 2"],
    [undefined, {}, "windowPosition cannot be undefined"],
    [{ x: 1, y: 1 }, { window: Number.NaN }, "options.window cannot be NaN. Use a number from 0 to 1000"],
    [{ x: 1, y: 1 }, { window: -1 }, "options.window cannot be -1"],
    [{ x: 1, y: 1 }, { window: 1e9 }, "options.window cannot be 1000000000"],
    [{ x: 1, y: 1 }, { signal: new AbortController() }, "Use an AbortSignal"],
    [{ x: 1, y: 1 }, { widow: 5 }, 'Did you mean "window"'],
    [{ x: 1, y: 1 }, null, "options cannot be null"],
  ])("a pick at %o with %o is refused", async (position, options, text) => {
    const layer = PointCloudLayer.fromCloud(await open());
    await expect(layer.pick(position as never, options as never)).rejects.toEqual(refused(text));
    expect(await layer.pick(new Cartesian3(1, 2, 3), { window: 1000, signal: undefined })).toBeUndefined();
  });

  it("of a call on a data set are refused", async () => {
    const cloud = await open();
    const wrong = { signal: {} } as never;
    await expect(cloud.loadNode("0-0-0-0", wrong)).rejects.toEqual(refused("Use an AbortSignal"));
    await expect(cloud.readPoint("0-0-0-0", 0, wrong)).rejects.toEqual(refused("Use an AbortSignal"));
    expect(() => cloud.query({ spacing: Number.NaN })).toThrow(refused("options.spacing cannot be NaN"));
    expect(() => cloud.query({ voulme: 1 } as never)).toThrow(refused('Did you mean "volume"'));
  });

  it("heightOffset is a number", async () => {
    const cloud = await open();
    for (const heightOffset of ["5", [5]]) {
      expect(() => PointCloudLayer.fromCloud(cloud, { heightOffset } as never)).toThrow(
        "STYLE_HEIGHT_OFFSET",
      );
    }
  });
});

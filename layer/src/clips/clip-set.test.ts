import { eastNorthUp, geodeticToEcef } from "@groma/georef";
import { describe, expect, it } from "vitest";
import { Clip } from "./clip.js";
import { ClipSet } from "./clip-set.js";
import { EARTH } from "./clip-shader.fixture.js";
import type { Corner } from "./source-space.js";
import type { SourceSpace } from "./volume.js";

const SQUARE = [
  [0, 0],
  [0.1, 0],
  [0.1, 0.1],
  [0, 0.1],
] as const;

describe("ClipSet", () => {
  const center = { longitude: 0, latitude: 0, height: 0 };
  it("compiles each volume once, whatever comes and goes beside it, and in steps what it compiles at once", () => {
    let places = 0;
    const space: SourceSpace = {
      place(x, y, z, out) {
        places++;
        const [longitude, latitude] = [1e-7 * x, 1e-7 * y];
        geodeticToEcef(longitude, latitude, z, out);
        return out;
      },
      boundingBox: { min: [0, 0, 0], max: [1000, 1000, 10] },
    };
    const ring = Array.from({ length: 300 }, (_, index): Corner => {
      const angle = (2 * Math.PI * index) / 300;
      return [500 + 300 * Math.cos(angle), 500 + 300 * Math.sin(angle)];
    });
    const set = new ClipSet([Clip.polygon(ring, { coordinates: "source" })]);
    const node = {
      frame: eastNorthUp(space.place(800, 500, 0, new Float64Array(3))),
      box: [-9, -9, -9, 9, 9, 9],
    };
    const steps = set.overInSteps(space);
    let count = 0;
    while (!steps.next().done) count++;
    expect(count).toBeGreaterThan(10);
    const alone = set.over(space).forNode(node);
    expect(alone).toEqual(new ClipSet(set).over(space).forNode(node));
    const before = places;
    const box = set.add(Clip.box({ center, size: [1, 1, 1], mode: "outside" }));
    set.over(space);
    set.remove(box);
    expect(set.over(space).forNode(node)).toEqual(alone);
    expect(places).toBe(before);
  });

  it("tells of its changes and compiles anew after them", () => {
    const set = new ClipSet();
    let changes = 0;
    const stop = set.onChange(() => changes++);
    const box = set.add(Clip.box({ center, size: [1, 1, 1] }));
    const before = set.over(EARTH);
    expect(set.over(EARTH)).toBe(before);
    const other = set.replace(box, Clip.box({ center, size: [2, 2, 2], mode: "outside" }));
    expect(set.over(EARTH)).not.toBe(before);
    expect([set.remove(box), set.remove(other), set.size]).toEqual([false, true, 0]);
    stop();
    set.add(box);
    expect([changes, set.revision]).toEqual([3, 4]);
    set.clear();
    expect([...set]).toEqual([]);
  });

  it.each([
    ["mode", Clip.box({ center, size: [1, 1, 1], mode: "beside" as "inside" })],
    ["size", Clip.box({ center, size: [1, 0, 1] })],
    ["place", Clip.plane({ through: { longitude: 0, latitude: 2, height: 0 } })],
    [
      "corners",
      Clip.polygon([
        [0, 0],
        [1, 1],
        [0, 0],
      ]),
    ],
    [
      "degrees",
      Clip.polygon([
        [0, 0],
        [10, 10],
        [10, 0],
      ]),
    ],
    [
      "heights",
      Clip.polygon(
        [
          [0, 0],
          [0.1, 0.1],
          [0.1, 0],
        ],
        { bottom: 3, top: 3 },
      ),
    ],
  ])("refuses a wrong %s", (_, clip) => {
    expect(() => new ClipSet().add(clip)).toThrow(
      expect.objectContaining({ code: "STYLE_CLIP", name: "StyleError" }),
    );
  });

  it.each<readonly [string, unknown]>([
    ["volume", undefined],
    ["volume", { mode: "inside", kind: "sphere" }],
    ["place", Clip.box({ center: null as never, size: [1, 1, 1] })],
    ["box", Clip.box({ center: { source: [1, 2, 3] }, size: undefined as never })],
    ["box", Clip.box({ center: { source: [1, 2, 3] }, size: [1, 1] as never })],
    ["angle", Clip.box({ center: { source: [1, 2, 3] }, size: [1, 1, 1], heading: Number.NaN })],
    ["corner", { ...Clip.polygon([[0, 0]]), ring: [[0, 0], [0, 0.1], undefined] }],
    ["bottom", Clip.polygon(SQUARE, { bottom: Number.NaN })],
    [
      "polygon around half the earth",
      Clip.polygon([
        [0, -1],
        [2, 1],
        [4, -1],
        [5, 0.2],
      ]),
    ],
  ])("refuses what is no %s at once, and stays as it was", (_, clip) => {
    const set = new ClipSet([Clip.polygon(SQUARE)]);
    expect(() => set.add(clip as Clip)).toThrow(expect.objectContaining({ code: "STYLE_CLIP" }));
    expect([set.size, set.revision]).toEqual([1, 1]);
  });

  it.each<readonly [unknown, string]>([
    [
      Clip.box({ center, size: [1, 1, 1], headng: 1 } as never),
      'a box has no "headng". Did you mean "heading"? Otherwise use mode, center, size, heading, pitch or roll',
    ],
    [Clip.box({ centre: center, size: [1, 1, 1] } as never), 'a box has no "centre". Did you mean "center"?'],
    [Clip.plane({ through: center, roll: 1 } as never), 'a plane has no "roll". Use mode, through, heading'],
    [Clip.polygon(SQUARE, { botom: 3 } as never), 'a polygon has no "botom". Did you mean "bottom"?'],
    [Clip.polygon(SQUARE, { mode: "insde" } as never), 'unknown mode "insde". Did you mean "inside"?'],
    [{ ...Clip.polygon(SQUARE), mode: "toString" }, 'unknown mode "toString". Use inside, outside or'],
    [{ ...Clip.polygon(SQUARE), kind: "constructor" }, "this is not a clip volume"],
  ])("refuses misspelt names and says what was meant: %j", (clip, message) => {
    const set = new ClipSet();
    expect(() => set.add(clip as Clip)).toThrow(expect.objectContaining({ code: "STYLE_CLIP" }));
    expect(() => set.add(clip as Clip)).toThrow(message);
    expect(set.size).toBe(0);
  });

  it("holds polygons that reach almost 85° from their middle", () => {
    const reach = (84.5 * Math.PI) / 180;
    const corners = [0, 1, 2, 3, 4].map((index) => [(index * 2 * Math.PI) / 5, Math.PI / 2 - reach] as const);
    const volumes = new ClipSet([Clip.polygon(corners)]).over(EARTH);
    const stays = (latitude: number) => {
      const ecef = new Float64Array(3);
      geodeticToEcef(0.3, latitude, 0, ecef);
      return volumes.keeps(ecef, [0, 0, 0]);
    };
    expect([1.5, 0.9, 0, -1].map(stays)).toEqual([true, true, false, false]);
  });

  it("refuses volumes in source coordinates that are not the data set's", () => {
    // Metres of a map near (800, 500), as some 100 km of them lie about the equator.
    const space: SourceSpace = {
      place(x, y, z, out) {
        geodeticToEcef(x / 6_378_137, y / 6_378_137, z, out);
        return out;
      },
      boundingBox: { min: [500_000, 500_000, 0], max: [501_000, 501_000, 10] },
    };
    const through = (...source: [number, number, number]) =>
      new ClipSet([Clip.plane({ through: { source } })]).over(space);
    expect(() => through(8.5, 47.3, 500)).toThrow(
      expect.objectContaining({
        code: "STYLE_CLIP",
        message: expect.stringMatching(
          /\(8\.5, 47\.3, 500\) lies too far from the data set.*source coordinates/,
        ),
      }),
    );
    expect(() => through(Number.MAX_VALUE, 0, 0)).toThrow(expect.objectContaining({ code: "STYLE_CLIP" }));
    expect(through(590_000, 500_500, 0).cutting).toBe(1);
  });
});

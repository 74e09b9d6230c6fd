import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { Clip } from "../clips/index.js";
import { completeStyle, defaultStyle } from "../effects/index.js";
import { layerView, readPermalink, type SharedView, writePermalink } from "./index.js";
import { asText } from "./json-text.js";

const DEGREE = Math.PI / 180;
const cloud = {
  name: "a.copc.laz",
  attributes: [{ name: "intensity", kind: "number", range: [0, 1] }],
} as unknown as Parameters<typeof completeStyle>[2];
const byDefault = defaultStyle(cloud);
const degrees = (most: number) => fc.double({ min: -most, max: most, noNaN: true });

describe("a permalink", () => {
  it("brings back what was written, cameras to a centimetre and a hundredth of a degree", () => {
    const camera = fc.tuple(
      degrees(180),
      degrees(90),
      fc.double({ min: -1e4, max: 1e9, noNaN: true }),
      degrees(360),
    );
    const filter = fc.record({
      classes: fc.array(fc.integer({ min: 0, max: 255 })),
      ranges: fc.dictionary(
        fc.string().filter((name) => name !== "__proto__"),
        fc.constantFrom([0, 1], [Number.NEGATIVE_INFINITY, 3.25], [2, Number.POSITIVE_INFINITY]),
      ),
    });
    fc.assert(
      fc.property(camera, filter, ([longitude, latitude, height, heading], shown) => {
        const at = { longitude, latitude, heading, pitch: -latitude, roll: 0 };
        const radians = Object.fromEntries(Object.entries(at).map(([name, one]) => [name, one * DEGREE]));
        const view = { camera: { ...radians, height }, filter: shown } as unknown as SharedView;
        const text = writePermalink(view);
        // Nothing of it is escaped in an address.
        expect(new URL(`http://a/#view=${text}`).hash).toBe(`#view=${text}`);
        expect(encodeURIComponent(text)).toBe(text);
        const back = readPermalink(text);
        expect(JSON.stringify(back.filter)).toBe(JSON.stringify(shown));
        expect(back.filter).toEqual(shown);
        expect(Math.abs(back.camera!.longitude / DEGREE - longitude)).toBeLessThan(1e-7);
        expect(Math.abs(back.camera!.latitude / DEGREE - latitude)).toBeLessThan(1e-7);
        expect(Math.abs(back.camera!.height - height)).toBeLessThan(0.0051);
        expect(Math.abs(back.camera!.heading / DEGREE - heading)).toBeLessThan(0.0051);
      }),
    );
  });

  it("keeps how further clouds are drawn, in their order, and reads links without them", () => {
    const others = [{ style: { color: "intensity" } }, {}, { filter: { classes: [2] } }] as const;
    const text = writePermalink({ style: { color: "rgb" }, others });
    expect(encodeURIComponent(text)).toBe(text);
    expect(readPermalink(text)).toEqual({ style: { color: "rgb" }, others });
    expect(writePermalink({ others: [{}, {}] })).toBe("1");
    expect(readPermalink("1").others).toBeUndefined();
    const many = Array.from({ length: 150 }, () => others[0]);
    expect(readPermalink(writePermalink({ others: many })).others).toHaveLength(100);
  });

  it("keeps which clouds are hidden, and how far they are drawn above their places", () => {
    const others = [{ show: false }, { style: { color: "rgb" }, heightOffset: 2 }] as const;
    const view = { heightOffset: -22.4, others };
    expect(readPermalink(writePermalink(view))).toEqual(view);
    const layer = { style: byDefault, filter: undefined, clips: [], cloud };
    expect(writePermalink(layerView({ ...layer, show: true, heightOffset: 0 }))).toBe("1");
    // Layers have accessors, which no copy of an object has.
    const hidden = Object.assign(Object.create({ show: false }), layer);
    expect(readPermalink(writePermalink(layerView(hidden)))).toEqual({ show: false });
  });

  it.each([{ show: 0 }, { heightOffset: null }, { heightOffset: "5" }, { lift: 5 }])(
    "refuses what is no display of a cloud: %j",
    (value) => {
      expect(() => readPermalink(`1~d${asText(value)}`)).toThrow("LINK_BROKEN");
      expect(() => readPermalink(`1~o${asText([[{}, {}, value]])}`)).toThrow("LINK_BROKEN");
    },
  );

  it.each([{}, [[{}]], [[{}, 1]], [[{}, {}, {}, {}]], [1], Array.from({ length: 101 }, () => [{}, {}])])(
    "refuses what is no list of clouds: %j",
    (value) => {
      expect(() => readPermalink(`1~o${asText(value)}`)).toThrow("LINK_BROKEN");
    },
  );

  it("is short, and keeps of a style what was changed", () => {
    const style = completeStyle(
      { color: "intensity", highlight: { share: 1 }, classes: { 6: { show: false } } },
      byDefault,
      cloud,
    );
    const shown = (of: typeof style) => layerView({ style: of, filter: undefined, clips: [], cloud });
    const { style: changed } = shown(style);
    expect(changed).toEqual({ color: "intensity", highlight: { share: 1 }, classes: { 6: { show: false } } });
    const camera = { longitude: 0.149, latitude: 0.826, height: 1200, heading: 0.5, pitch: -0.78, roll: 0 };
    const text = writePermalink({ camera, ...shown(style), selected: { node: "3-1-2-0", index: 17 } });
    expect(text.length).toBeLessThan(200);
    const back = readPermalink(text);
    expect(completeStyle(back.style!, byDefault, cloud)).toEqual(style);
    expect(back.selected).toEqual({ node: "3-1-2-0", index: 17 });
    expect(writePermalink(shown(byDefault))).toBe("1");
    expect(readPermalink("1")).toEqual({});
  });

  it("keeps the profile that is shown, to the last digit", () => {
    const profile = {
      ...{ name: "Deich ~ 7", width: 4.4, start: -250.5 },
      line: [
        [0.14912345678901234, 0.8261234567890123, 412.25],
        [-Math.PI, -Math.PI / 2, -3],
      ],
      equations: [{ internal: 50, ahead: 5000, increment: "decreasing" }],
    } as const;
    const text = writePermalink({ profile });
    expect(encodeURIComponent(text)).toBe(text);
    expect(readPermalink(text)).toEqual({ profile });
    const { equations: _, ...plain } = profile;
    expect(readPermalink(writePermalink({ profile: plain }))).toEqual({ profile: plain });
    // Whatever else stands there is not taken.
    expect(readPermalink(`1~l${asText({ ...plain, more: 1 })}`)).toEqual({ profile: plain });
    for (const wrong of [
      ...[{ name: 7 }, { width: 0 }, { width: null }, { start: "0" }, { line: [[0, 0, 0]] }],
      ...[
        {
          line: [
            [0, 0],
            [0, 1],
          ],
        },
        {
          line: [
            [0, 0, 0],
            [4, 0, 0],
          ],
        },
        {
          line: [
            [0, 2, 0],
            [0, 0, 0],
          ],
        },
      ],
      ...[{ equations: {} }, { equations: [null] }, { equations: [{ internal: 1, ahead: 2, increment: 1 }] }],
      { equations: [1, 2].map((ahead) => ({ internal: 1, ahead })) },
    ]) {
      expect(() => readPermalink(`1~l${asText({ ...profile, ...wrong })}`)).toThrow("LINK_BROKEN");
    }
  });

  it("keeps volumes", () => {
    const clips = [
      Clip.box({
        center: { longitude: 0.1, latitude: 0.8, height: 500 },
        size: [10, 20, 30],
        mode: "highlight",
      }),
      Clip.plane({ through: { source: [1, 2, 3] }, pitch: 1 }),
    ];
    expect(readPermalink(writePermalink({ clips })).clips).toEqual(clips);
    const odd = [{ ...clips[0]!, colour: "red" }] as unknown as typeof clips;
    expect(() => readPermalink(writePermalink({ clips: odd }))).toThrow(
      expect.objectContaining({ code: "STYLE_CLIP", message: expect.stringContaining("colour") }),
    );
  });

  it.each([
    ["2~c1_2_3_4_5_6", "LINK_VERSION", '"2"'],
    ["", "LINK_VERSION", '""'],
    ["1~x17", "LINK_PART", '"x17"'],
    ["1~c1_2_3_4_5", "LINK_BROKEN", "camera"],
    ["1~c1_92_3_4_5_6", "LINK_BROKEN", "camera"],
    ["1~c1_2_3_4_5_", "LINK_BROKEN", "camera"],
    ["1~c9_45_1e300_0_-90_0", "LINK_BROKEN", "camera"],
    ["1~c9_45_-6370000_0_-90_0", "LINK_BROKEN", "camera"],
    ["1~s!!!", "LINK_BROKEN", "style"],
    ["1~fMTc", "LINK_BROKEN", "filter"],
    ["1~ke30", "LINK_BROKEN", "clips"],
    ["1~p3-1-2_17", "LINK_BROKEN", "selected"],
    ["1~p3-1-2-0_1~p3-1-2-0_1", "LINK_BROKEN", "twice"],
  ])("%s is refused by name: %s", (text, code, named) => {
    expect(() => readPermalink(text)).toThrow(
      expect.objectContaining({ code, message: expect.stringContaining(named) }),
    );
  });

  it("longer than any link is not looked into", () => {
    expect(() => readPermalink(`1~s${"A".repeat(200_000)}`)).toThrow("longer");
  });

  it("is not written where it could not be read again", () => {
    const ringOf = (corners: number) =>
      Array.from({ length: corners }, (_, at) => {
        const angle = (2 * Math.PI * at) / corners;
        return [1e-3 * Math.cos(angle), 1e-3 * Math.sin(angle)] as const;
      });
    const linkOf = (corners: number) => writePermalink({ clips: [Clip.polygon(ringOf(corners))] });
    expect(readPermalink(linkOf(1_000)).clips).toEqual([Clip.polygon(ringOf(1_000))]);
    for (const corners of [5_000, 200_000])
      expect(() => linkOf(corners)).toThrow(expect.objectContaining({ code: "LINK_LONG" }));
  });

  it("whatever it is, gives a view or one clear error", () => {
    fc.assert(
      fc.property(
        fc.string({ maxLength: 40 }),
        fc.constantFrom("1~c", "1~s", "1~f", "1~k", "1~p", "1~", ""),
        (text, start) => {
          try {
            readPermalink(start + text);
          } catch (thrown) {
            expect((thrown as { code: string }).code).toMatch(/^(LINK|STYLE)_/);
          }
        },
      ),
    );
  });
});

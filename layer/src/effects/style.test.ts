import { describe, expect, it } from "vitest";
import { EFFECTS, type PointCloudStyle } from "./catalogue/index.js";
import { ASPRS_CLASSES } from "./declaration/classes.js";
import { GRADIENTS } from "./declaration/gradients.js";
import { hasOwnTest, richFacts, styleOf } from "./scene.fixture.js";
import { completeStyle, defaultStyle, STYLE_OPTIONS, type StyleParts } from "./style.js";

const attributes = [...richFacts().attributes, { name: "normals", kind: "scalar", components: 3 }] as const;
const cloud = { attributes, name: "a.copc.laz" };
const complete = (given: unknown, base = styleOf()) => completeStyle(given as StyleParts, base, cloud);

/** What the documentation says of a style that was given nothing. */
const DEFAULTS = {
  color: "rgb",
  blend: undefined,
  gradient: "auto",
  range: undefined,
  gamma: 1,
  brightness: 0,
  contrast: 0,
  classes: ASPRS_CLASSES,
  size: "fixed",
  pointSize: 2,
  spacingFactor: 2,
  minimumSize: 1,
  maximumSize: 50,
  shape: "square",
  splats: false,
  hardness: 2,
  eyeDomeLighting: false,
  opacity: 1,
  highlight: { color: [1, 0, 0], share: 0.6 },
  dithering: false,
} satisfies Partial<PointCloudStyle>;

const NO_NUMBERS = [Number.NaN, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY, "1", true, null, {}, [1]];
const stop = (at: unknown, color: unknown = [0, 0, 0]) => ({ at, color });

/** Values of a number from its least to its greatest, and what is none. */
function numbers(least: number, greatest: number) {
  const step = 1e-9;
  return {
    valid: [least, (least + greatest) / 2, greatest],
    invalid: [least - step, greatest + step, ...NO_NUMBERS],
    says: `a number from ${least} to ${greatest}`,
  };
}

/**
 * What each property may be and may not, with the code of its error and words of the fix. Those of an effect with a test
 * of its own stand there.
 */
const VALUES: Readonly<
  Record<keyof typeof DEFAULTS, { valid: unknown[]; invalid: unknown[]; code: string; says: string }>
> = {
  color: {
    code: "STYLE_COLOR",
    valid: ["rgb", "elevation", "classification", "levelOfDetail", "echo width [ns]"],
    invalid: ["heat", "color", "normals", "constructor", "__proto__", "", 3, null, ["rgb"], {}],
    says: "use rgb, elevation, intensity, gpsTime, classification, echo width [ns] or levelOfDetail",
  },
  blend: {
    code: "STYLE_BLEND",
    valid: [
      { color: "intensity", share: 0 },
      { color: "rgb", share: 1 },
    ],
    invalid: [
      { share: 0.5 },
      { color: "heat" },
      { color: "intensity", share: 1.1 },
      { color: "intensity", part: 1 },
      "intensity",
      null,
      false,
    ],
    says: "use",
  },
  gradient: {
    code: "STYLE_GRADIENT",
    valid: ["auto", "viridis", "terrain", [stop(0), stop(0), stop(1)], [stop(0.2), stop(0.4, [1, 1, 1])]],
    invalid: [
      "rainbow",
      "toString",
      [],
      [stop(0)],
      [stop(1), stop(0)],
      [stop(-0.1), stop(1)],
      [stop(0), stop(Number.NaN)],
      [stop(0), stop(1, "red")],
      [stop(0), { at: 1 }],
      [stop(0), { ...stop(1), colour: 1 }],
      [stop(0), 1],
      5,
      null,
      { viridis: true },
    ],
    says: "use",
  },
  range: {
    code: "STYLE_RANGE",
    valid: [
      [-5, 5],
      [0, 1e-9],
    ],
    invalid: [
      [2, 2],
      [3, 2],
      [0, Number.NaN],
      [0, Number.POSITIVE_INFINITY],
      [0],
      [0, 1, 2],
      "01",
      4,
      null,
      { least: 0, greatest: 1 },
    ],
    says: "use two numbers, the second greater than the first",
  },
  gamma: { code: "STYLE_TONE", ...numbers(0.1, 10) },
  brightness: { code: "STYLE_TONE", ...numbers(-1, 1) },
  contrast: { code: "STYLE_TONE", ...numbers(-1, 1) },
  classes: {
    code: "STYLE_CLASSES",
    valid: [ASPRS_CLASSES],
    invalid: [
      { 256: {} },
      { "-1": {} },
      { "01": {} },
      { "": {} },
      { "1e1": {} },
      { ground: {} },
      JSON.parse('{ "__proto__": {} }'),
      { 3: { color: [255, 0, 0] } },
      { 3: { show: 1 } },
      { 3: { name: 3 } },
      { 3: { colour: [0, 0, 0] } },
      { 3: false },
      [],
      "all",
      null,
    ],
    says: "use",
  },
  size: {
    code: "STYLE_SIZE",
    valid: ["fixed", "attenuated", "adaptive"],
    invalid: ["large", "Fixed", 3, null, true, ["fixed"]],
    says: "use fixed, attenuated or adaptive",
  },
  pointSize: { code: "STYLE_POINT_SIZE", ...numbers(1, 64) },
  spacingFactor: { code: "STYLE_POINT_SIZE", ...numbers(0.1, 10) },
  minimumSize: { code: "STYLE_POINT_SIZE", ...numbers(0, 256), valid: [0, 7, 50] },
  maximumSize: { code: "STYLE_POINT_SIZE", ...numbers(1, 256) },
  shape: {
    code: "STYLE_SHAPE",
    valid: ["square", "disc", "paraboloid"],
    invalid: ["cube", "splats", null, true],
    says: "use square, disc or paraboloid",
  },
  splats: {
    code: "STYLE_SPLATS",
    valid: [true, false, "auto"],
    invalid: ["yes", "true", 1, null, {}],
    says: "use true, false or auto",
  },
  hardness: { code: "STYLE_SPLATS", ...numbers(0.5, 50) },
  eyeDomeLighting: {
    code: "STYLE_EYE_DOME",
    valid: [
      true,
      false,
      "auto",
      { strength: 0, radius: 0.5, neighbours: 4 },
      { strength: 10, radius: 20, neighbours: 8 },
    ],
    invalid: [
      "on",
      1,
      null,
      [],
      { strength: -1 },
      { strength: Number.NaN },
      { strength: 10.1 },
      { radius: 0.4 },
      { radius: 20.1 },
      { radius: "2" },
      { neighbours: 6 },
      { neighbours: "4" },
      { raduis: 2 },
    ],
    says: "use",
  },
  opacity: { code: "STYLE_OPACITY", ...numbers(0, 1) },
  highlight: {
    code: "STYLE_HIGHLIGHT",
    valid: [
      { color: [0, 1, 0], share: 0 },
      { color: [1, 1, 1], share: 1 },
    ],
    invalid: [
      "red",
      [1, 0, 0],
      null,
      true,
      { color: "red" },
      { color: [1, 0] },
      { color: [2, 0, 0] },
      { share: 1.1 },
      { share: Number.NaN },
      { colour: [1, 0, 0] },
    ],
    says: "use",
  },
  dithering: {
    code: "STYLE_DITHERING",
    valid: [true, false],
    invalid: [1, 0, "true", "auto", null, {}],
    says: "use true or false",
  },
};

describe("the properties of a style", () => {
  it("are those of the documentation, each with its default", () => {
    const tested = EFFECTS.filter(({ name }) => hasOwnTest(name)).flatMap(({ options }) =>
      Object.keys(options),
    );
    expect(
      Object.keys({ ...DEFAULTS, ...Object.fromEntries(tested.map((name) => [name, 0])) }).sort(),
    ).toEqual([...STYLE_OPTIONS.keys()].sort());
    expect(defaultStyle(cloud)).toMatchObject(DEFAULTS);
    const colourless = { attributes: attributes.filter(({ name }) => name !== "rgb") };
    expect(defaultStyle(colourless)).toMatchObject({ ...DEFAULTS, color: "elevation" });
  });

  it.each(Object.entries(VALUES))(
    "%s takes what is valid and nothing else",
    (name, { valid, invalid, code, says }) => {
      expect(valid.length * invalid.length).toBeGreaterThan(0);
      for (const value of valid) expect(complete({ [name]: value })).toEqual({ ...styleOf(), [name]: value });
      for (const value of invalid) {
        const attempt = () => complete({ [name]: value });
        const about = `${name}: ${JSON.stringify(value)}`;
        expect(attempt, about).toThrow(
          expect.objectContaining({ code, file: "a.copc.laz", name: "StyleError" }),
        );
        expect(attempt, about).toThrow(expect.objectContaining({ fix: expect.stringContaining(says) }));
      }
    },
  );

  it.each<[unknown, string, string]>([
    [
      { colour: "rgb" },
      "STYLE_OPTION",
      'a style has no "colour". Did you mean "color"? Otherwise use color, size',
    ],
    [{ pointsize: 3 }, "STYLE_OPTION", 'Did you mean "pointSize"?'],
    [{ highQuality: true }, "STYLE_OPTION", 'a style has no "highQuality". Use color'],
    [JSON.parse('{ "__proto__": { "gamma": 2 } }'), "STYLE_OPTION", 'a style has no "__proto__"'],
    [{ constructor: 1 }, "STYLE_OPTION", 'a style has no "constructor"'],
    [null, "STYLE_OPTION", "a style cannot be null. Use an object"],
    ["rgb", "STYLE_OPTION", 'a style cannot be "rgb"'],
    [[], "STYLE_OPTION", "a style cannot be an empty array"],
    [{ color: "intensty" }, "STYLE_COLOR", 'color cannot be "intensty". Did you mean "intensity"?'],
    [
      { size: "adaptve" },
      "STYLE_SIZE",
      'Did you mean "adaptive"? Otherwise use fixed, attenuated or adaptive',
    ],
    [{ shape: "dics" }, "STYLE_SHAPE", 'Did you mean "disc"?'],
    [{ gradient: "virdis" }, "STYLE_GRADIENT", 'Did you mean "viridis"?'],
    [
      {
        gradient: [
          { at: 0, color: [0, 0, 0] },
          { at: 1, colour: [0, 0, 0] },
        ],
      },
      "STYLE_GRADIENT",
      'gradient[1] has no "colour". Did you mean "color"?',
    ],
    [
      {
        gradient: [
          { at: 1, color: [0, 0, 0] },
          { at: 0, color: [0, 0, 0] },
        ],
      },
      "STYLE_GRADIENT",
      "the stops of gradient do not form a gradient. Use two stops or more",
    ],
    [
      { blend: { color: "intensity", shara: 0.5 } },
      "STYLE_BLEND",
      'blend has no "shara". Did you mean "share"?',
    ],
    [
      { blend: { color: "intensty" } },
      "STYLE_BLEND",
      'blend.color cannot be "intensty". Did you mean "intensity"?',
    ],
    [
      { eyeDomeLighting: { raduis: 2 } },
      "STYLE_EYE_DOME",
      'eyeDomeLighting has no "raduis". Did you mean "radius"? Otherwise use strength, radius or neighbours',
    ],
    [
      { eyeDomeLighting: { radius: -1 } },
      "STYLE_EYE_DOME",
      "eyeDomeLighting.radius cannot be -1. Use a number from 0.5 to 20",
    ],
    [
      { highlight: { colour: [1, 0, 0] } },
      "STYLE_HIGHLIGHT",
      'highlight has no "colour". Did you mean "color"?',
    ],
    [
      { classes: { 6: { shwo: true } } },
      "STYLE_CLASSES",
      'classes.6 has no "shwo". Did you mean "show"? Otherwise use name, color or show',
    ],
    [{ classes: { 300: {} } }, "STYLE_CLASSES", 'unknown class "300". Use numbers from 0 to 255'],
    [{ minimumSize: 9, maximumSize: 3 }, "STYLE_POINT_SIZE", "sizes cannot run from 9 to 3 pixels"],
    [{ minimumSize: 51 }, "STYLE_POINT_SIZE", "sizes cannot run from 51 to 50 pixels"],
  ])("%j: %s", (given, code, message) => {
    expect(() => complete(given)).toThrow(expect.objectContaining({ code, name: "StyleError" }));
    expect(() => complete(given)).toThrow(message);
  });

  it("have no colours of the scan where it has none", () => {
    const colourless = { ...cloud, attributes: attributes.filter(({ name }) => name !== "rgb") };
    for (const given of [{ color: "rgb" }, { blend: { color: "rgb" } }] as const) {
      expect(() => completeStyle(given, defaultStyle(colourless), colourless)).toThrow(
        expect.objectContaining({ code: "STYLE_NO_RGB" }),
      );
    }
  });

  it("may name attributes as prototypes do, where the data set has them", () => {
    const odd = { ...cloud, attributes: [...attributes, { name: "__proto__", kind: "scalar" } as const] };
    expect(completeStyle({ color: "__proto__" }, styleOf(), odd).color).toBe("__proto__");
  });
});

describe("a style in parts", () => {
  it("keeps what is not given, and what is undefined", () => {
    const base = styleOf({ color: "elevation", range: [1, 2] });
    expect(complete({ pointSize: 5 }, base)).toEqual({ ...base, pointSize: 5 });
    expect(complete({ pointSize: undefined, gamma: undefined }, base)).toEqual(base);
  });

  it("takes back a range and a blend", () => {
    const base = styleOf({ range: [1, 2], blend: { color: "intensity", share: 0.5 } });
    expect(complete({ range: undefined, blend: undefined }, base)).toEqual(styleOf());
    expect(complete({ pointSize: 3 }, base).range).toEqual([1, 2]);
  });

  it("completes Eye-Dome Lighting from the numbers that stand, else from the defaults", () => {
    const numbers = { strength: 0.4, radius: 2, neighbours: 4 } as const;
    for (const before of [true, false, "auto"] as const) {
      const style = complete({ eyeDomeLighting: { radius: 2 } }, styleOf({ eyeDomeLighting: before }));
      expect(style.eyeDomeLighting).toEqual(numbers);
    }
    const base = styleOf({ eyeDomeLighting: { strength: 1, radius: 9, neighbours: 8 } });
    expect(complete({ eyeDomeLighting: { radius: 2 } }, base).eyeDomeLighting).toEqual({
      strength: 1,
      radius: 2,
      neighbours: 8,
    });
    expect(complete({ eyeDomeLighting: {} }).eyeDomeLighting).toEqual({ ...numbers, radius: 1.4 });
  });

  it("completes a highlight and a blend", () => {
    expect(complete({ highlight: { share: 1 } }).highlight).toEqual({ color: [1, 0, 0], share: 1 });
    expect(complete({ highlight: { color: [0, 0, 1] } }).highlight).toEqual({ color: [0, 0, 1], share: 0.6 });
    expect(complete({ blend: { color: "intensity" } }).blend).toEqual({ color: "intensity", share: 0.5 });
    const base = styleOf({ blend: { color: "intensity", share: 0.2 } });
    expect(complete({ blend: { share: 0.9 } }, base).blend).toEqual({ color: "intensity", share: 0.9 });
    expect(complete({ blend: { color: "gpsTime" } }, base).blend).toEqual({ color: "gpsTime", share: 0.2 });
  });

  it("edits single classes", () => {
    const once = complete({ classes: { 6: { show: false }, 64: { name: "vines", color: [0, 1, 0] } } });
    expect(once.classes[6]).toEqual({ ...ASPRS_CLASSES[6], show: false });
    expect(once.classes[64]).toEqual({ name: "vines", color: [0, 1, 0], show: true });
    expect(once.classes[2]).toBe(ASPRS_CLASSES[2]);
    const twice = complete({ classes: { 6: { color: [0, 0, 0] }, 64: undefined } }, once);
    expect(twice.classes[6]).toEqual({ name: "Building", color: [0, 0, 0], show: false });
    expect(twice.classes[64]).toEqual(once.classes[64]);
    expect(Object.keys(twice.classes)).toHaveLength(256);
  });
});

// Before any style has frozen what it holds.
const SHARED_BEFORE = [ASPRS_CLASSES, ASPRS_CLASSES[6], ASPRS_CLASSES[6].color].map((one) =>
  Object.isFrozen(one),
);

describe("what is shared", () => {
  it("is frozen by itself: the classes of ASPRS before a style holds them", () => {
    expect(SHARED_BEFORE).toEqual([true, true, true]);
  });

  const whole = {
    gradient: [stop(0), stop(1)],
    range: [0, 1],
    blend: { color: "intensity", share: 0.5 },
    classes: { 6: { color: [0, 0, 1] } },
    eyeDomeLighting: { radius: 3 },
    highlight: { color: [0, 0, 1] },
  };

  /** All objects in a value. */
  const objectsIn = (value: unknown): object[] =>
    typeof value === "object" && value !== null ? [value, ...Object.values(value).flatMap(objectsIn)] : [];

  it.each<[string, unknown]>([
    ["the default style", defaultStyle(cloud)],
    ["a style that was given", complete(whole)],
    ["the classes of ASPRS", ASPRS_CLASSES],
    ["the gradients", GRADIENTS],
  ])("is frozen: %s", (_, value) => {
    const all = objectsIn(value);
    expect(all.length).toBeGreaterThan(10);
    expect(all.filter((one) => !Object.isFrozen(one))).toEqual([]);
  });

  it("is nothing of the caller's", () => {
    const given = structuredClone(whole);
    const style = complete(given);
    const theirs = new Set(objectsIn(given));
    expect(objectsIn(style).filter((one) => theirs.has(one))).toEqual([]);
    expect([...theirs].filter((one) => Object.isFrozen(one))).toEqual([]);
  });
});

import { describe, expect, it } from "vitest";
import { EFFECTS, type PointCloudStyle } from "./catalogue/index.js";
import { ASPRS_CLASSES } from "./declaration/classes.js";
import { hasOwnTest, styleOf } from "./scene.fixture.js";
import { attributes, cloud, complete, stop } from "./style.fixture.js";
import { completeStyle, defaultStyle, STYLE_OPTIONS } from "./style.js";

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

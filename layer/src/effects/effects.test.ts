import { describe, expect, it } from "vitest";
import { checkFilter } from "./check-filter.js";
import { ASPRS_CLASSES } from "./classes.js";
import { completeStyle, type StyleParts } from "./complete-style.js";
import { EFFECT_NAMES, type EffectName } from "./effect-plan.js";
import type { SceneFacts } from "./facts.js";
import { type PointFilter, passesFilter } from "./filter.js";
import { GRADIENTS, type GradientName, gradientAt } from "./gradients.js";
import { cloudPlacing, placingFacts } from "./placing-facts.js";
import { planEffects } from "./plan.js";
import { richFacts, styleOf } from "./scene.fixture.js";
import { defaultStyle, type PointCloudStyle } from "./style.js";
import { encodeVisibleOctree, type VisibleNode } from "./visible-octree.js";

const { attributes } = richFacts();
const cloud = { attributes, file: "a.copc.laz" };
const complete = (parts: StyleParts, base = styleOf()) => completeStyle(parts, base, cloud);

describe("style", () => {
  it("keeps what is not given, and begins with the scan's own colours where it has some", () => {
    const base = styleOf({ color: "elevation" });
    expect(complete({ pointSize: 5 }, base)).toEqual({ ...base, pointSize: 5 });
    expect(complete({ color: "echo width [ns]" }).color).toBe("echo width [ns]");
    expect([defaultStyle(true).color, defaultStyle(false).color]).toEqual(["rgb", "elevation"]);
  });

  it("edits single classes, and lights with what is not said by default", () => {
    const { classes } = complete({
      classes: { 6: { show: false }, 64: { name: "vines", color: [0, 1, 0] } },
    });
    expect(classes[6]).toEqual({ ...ASPRS_CLASSES[6], show: false });
    expect(classes[64]).toEqual({ name: "vines", color: [0, 1, 0], show: true });
    expect(classes[2]).toBe(ASPRS_CLASSES[2]);
    const partly = { strength: 1 } as unknown as boolean;
    expect(complete({ eyeDomeLighting: partly }).eyeDomeLighting).toEqual({
      strength: 1,
      radius: 1.4,
      neighbours: 4,
    });
  });

  it("takes back a range and a blend", () => {
    const base = styleOf({ range: [1, 2], blend: { color: "intensity", share: 0.5 } });
    expect(complete({ range: undefined, blend: undefined }, base)).toEqual(styleOf());
    expect(complete({ pointSize: 3 }, base).range).toEqual([1, 2]);
  });

  const noColours = { attributes: attributes.filter(({ name }) => name !== "color"), file: "a" };
  it.each<[string, unknown]>([
    ["STYLE_OPTION", { colour: "rgb" }],
    ["STYLE_COLOR", { color: "heat" }],
    ["STYLE_COLOR", { color: "color" }],
    ["STYLE_COLOR", { blend: { color: "heat", share: 0.5 } }],
    ["STYLE_BLEND", { blend: { color: "intensity", share: 2 } }],
    ["STYLE_GRADIENT", { gradient: "rainbow" }],
    ["STYLE_GRADIENT", { gradient: [{ at: 0, color: [0, 0, 0] }] }],
    [
      "STYLE_GRADIENT",
      {
        gradient: [
          { at: 1, color: [0, 0, 0] },
          { at: 0, color: [1, 1, 1] },
        ],
      },
    ],
    ["STYLE_RANGE", { range: [2, 2] }],
    ["STYLE_TONE", { gamma: 0 }],
    ["STYLE_TONE", { contrast: 1.5 }],
    ["STYLE_CLASSES", { classes: { 300: { show: true } } }],
    ["STYLE_CLASSES", { classes: { 3: { color: [255, 0, 0] } } }],
    ["STYLE_SIZE", { size: "large" }],
    ["STYLE_POINT_SIZE", { pointSize: 0 }],
    ["STYLE_POINT_SIZE", { pointSize: Number.NaN }],
    ["STYLE_POINT_SIZE", { pointSize: 65 }],
    ["STYLE_POINT_SIZE", { minimumSize: 9, maximumSize: 3 }],
    ["STYLE_POINT_SIZE", { spacingFactor: 0 }],
    ["STYLE_SHAPE", { shape: "cube" }],
    ["STYLE_QUALITY", { highQuality: "yes" }],
    ["STYLE_QUALITY", { hardness: 0 }],
    ["STYLE_EYE_DOME", { eyeDomeLighting: { strength: 1, radius: 1, neighbours: 6 } }],
    ["STYLE_EYE_DOME", { eyeDomeLighting: "on" }],
    ["STYLE_OPACITY", { opacity: -1 }],
    ["STYLE_HIGHLIGHT", { highlight: { color: "red", share: 1 } }],
    ["STYLE_DITHERING", { dithering: 1 }],
  ])("%s for %j", (code, parts) => {
    expect(() => complete(parts as StyleParts)).toThrow(
      expect.objectContaining({ code, name: "StyleError" }),
    );
  });

  it("STYLE_NO_RGB where the scan has no colours", () => {
    expect(() => completeStyle({ color: "rgb" }, defaultStyle(false), noColours)).toThrow(
      expect.objectContaining({ code: "STYLE_NO_RGB" }),
    );
  });

  it.each<[PointFilter]>([
    [{ classes: [256] }],
    [{ returns: ["third" as "first"] }],
    [{ ranges: { heat: [0, 1] } }],
    [{ ranges: { intensity: [5, 1] } }],
  ])("STYLE_FILTER for %j", (filter) => {
    expect(() => checkFilter(filter, cloud)).toThrow(expect.objectContaining({ code: "STYLE_FILTER" }));
  });
});

describe("gradients", () => {
  it.each(["viridis", "cividis", "greyscale"] as GradientName[])("%s grows lighter all the way", (name) => {
    // Luma of ITU-R BT.709.
    const luma = GRADIENTS[name].map(({ color: [r, g, b] }) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
    expect(luma).toEqual([...luma].sort((a, b) => a - b));
  });

  it("are linear between stops, and end with them", () => {
    const stops = [
      { at: 0.2, color: [0, 0, 0] as const },
      { at: 0.4, color: [1, 0.5, 0] as const },
      { at: 0.4, color: [0, 0, 1] as const },
    ];
    expect(gradientAt(stops, 0)).toEqual([0, 0, 0]);
    expect(gradientAt(stops, 0.25).map((part) => Number(part.toFixed(6)))).toEqual([0.25, 0.125, 0]);
    expect(gradientAt(stops, 1)).toEqual([0, 0, 1]);
  });
});

describe("the plan", () => {
  const active = (style: Partial<PointCloudStyle>, facts: Partial<SceneFacts> = {}) =>
    planEffects(styleOf(style), richFacts(facts)).active;
  const has = (name: EffectName, style: Partial<PointCloudStyle>, facts: Partial<SceneFacts> = {}) =>
    active(style, facts).has(name);

  it("runs each effect from its threshold on, and not before", () => {
    const near = { spacings: [1, 8] as const, groundSpacings: [0.2, 0.8] as const };
    expect(has("adaptiveSize", { size: "adaptive" }, near)).toBe(true);
    // One density only: one size on the ground is the same picture.
    const single = active({ size: "adaptive" }, { groundSpacings: [0.2, 0.2] });
    expect([single.has("adaptiveSize"), single.has("attenuatedSize")]).toEqual([false, true]);
    expect(has("disc", { shape: "disc", pointSize: 1 })).toBe(false);
    expect(has("disc", { shape: "disc", pointSize: 1.3 })).toBe(true);
    expect(has("paraboloid", { shape: "paraboloid", pointSize: 3.9 }, near)).toBe(false);
    expect(has("paraboloid", { shape: "paraboloid", pointSize: 4 }, near)).toBe(true);
    expect(has("splats", { highQuality: "auto", pointSize: 3 }, near)).toBe(false);
    expect(has("splats", { highQuality: "auto", pointSize: 5 }, near)).toBe(true);
    expect(has("eyeDomeLighting", { eyeDomeLighting: "auto" })).toBe(false);
    expect(has("eyeDomeLighting", { eyeDomeLighting: "auto", color: "intensity" })).toBe(true);
    expect(has("eyeDomeLighting", { eyeDomeLighting: "auto" }, { silhouettes: 0.02 })).toBe(true);
    expect(has("opacity", { opacity: 0.999 })).toBe(false);
    expect(has("tone", { gamma: 1.003 })).toBe(false);
    expect(has("tone", { gamma: 1.1 })).toBe(true);
    expect(has("blend", { blend: { color: "intensity", share: 0.001 } })).toBe(false);
    expect(has("dithering", { dithering: true })).toBe(false);
    expect(has("filter", { classes: { ...ASPRS_CLASSES, 7: { ...ASPRS_CLASSES[7], show: false } } })).toBe(
      true,
    );
  });

  it("can be forced, says so, and always leaves one size", () => {
    const forced = planEffects(styleOf({ size: "adaptive" }), richFacts(), {
      eyeDomeLighting: true,
      adaptiveSize: false,
      filter: true,
    });
    const row = (name: string) => forced.ledger.find(({ effect }) => effect === name)!;
    expect([row("eyeDomeLighting").active, row("eyeDomeLighting").why]).toEqual([true, "forced on"]);
    expect([row("adaptiveSize").active, row("adaptiveSize").why]).toEqual([false, "forced off"]);
    expect(forced.active.has("attenuatedSize")).toBe(true);
    // There is nothing to filter by.
    expect(forced.active.has("filter")).toBe(false);
    const two = planEffects(styleOf({ size: "adaptive" }), richFacts(), { fixedSize: true });
    expect([...two.active].filter((name) => name.endsWith("Size"))).toEqual(["fixedSize"]);
  });

  it("has a row for each effect, with numbers and words", () => {
    const { ledger } = planEffects(styleOf(), richFacts());
    expect(ledger.map(({ effect }) => effect).sort()).toEqual([...EFFECT_NAMES].sort());
    for (const { magnitude, why, source } of ledger) {
      expect(Number.isFinite(magnitude)).toBe(true);
      expect(why.length * source.length).toBeGreaterThan(0);
    }
  });

  it("tells what is known of the placing, from the data set's own map", () => {
    // 0.04 % too long, 47 m above the ellipsoid, on the equator, heights in feet.
    const placed = {
      place(x: number, y: number, z: number, out: Float64Array) {
        out.set([6_378_137 + 47 + z * 0.3048, (x - 500_000) / 0.9996, y / 0.9996]);
        return out;
      },
      boundingBox: { min: [499_900, -100, 0] as const, max: [500_100, 100, 300] as const },
      crs: { horizontalUnit: { kind: "linear" as const, size: 1 }, verticalUnit: { size: 0.3048 } },
      height: { kind: "geoid" as const },
      accuracy: { parts: [{ name: "datum operation", metres: null }] },
    };
    const nodes = [
      { scheme: "affine", bound: 4e-4, box: [-50, -50, 0, 50, 50, 20] },
      { scheme: "cubic", bound: 2e-6, box: [-1000, -1000, 0, 1000, 900, 20] },
    ];
    const placing = placingFacts(cloudPlacing(placed), nodes);
    const { ledger } = planEffects(
      styleOf(),
      richFacts({ placing, depthStepPixels: 3, logarithmicDepth: true }),
    );
    const row = (name: string) => ledger.find(({ effect }) => effect === name)!;
    expect(row("geoid").magnitude).toBeCloseTo(47, 3);
    expect(row("gridScale").magnitude).toBeCloseTo(1 / 0.9996 - 1, 6);
    expect(row("curvature").magnitude).toBeCloseTo(2000 ** 2 / 8 / 6_371_009, 6);
    expect(row("curvature")).toMatchObject({ active: true, threshold: 0.001, unit: "m" });
    expect(row("placing").magnitude).toBe(4e-4);
    expect(row("storage").magnitude).toBeCloseTo(Math.sqrt(3) * 1000 * 2 ** -24, 9);
    expect(row("datum operation").magnitude).toBeNaN();
    expect(row("logarithmicDepth")).toMatchObject({ magnitude: 3, threshold: 0.25, active: true });
  });
});

describe("filters on exact records", () => {
  const filter: PointFilter = { returns: ["intermediate", "single"], ranges: { gpsTime: [10, 20] } };
  it.each<[Record<string, number>, boolean]>([
    [{ classification: 2, returnNumber: 2, numberOfReturns: 3, gpsTime: 10 }, true],
    [{ classification: 2, returnNumber: 1, numberOfReturns: 1, gpsTime: 20 }, true],
    [{ classification: 2, returnNumber: 1, numberOfReturns: 2, gpsTime: 15 }, false],
    [{ classification: 2, returnNumber: 2, numberOfReturns: 2, gpsTime: 15 }, false],
    [{ classification: 2, returnNumber: 2, numberOfReturns: 3, gpsTime: 20.000001 }, false],
    [{ classification: 7, returnNumber: 2, numberOfReturns: 3, gpsTime: 15 }, false],
    [{ classification: 2, returnNumber: 2, numberOfReturns: 3 }, false],
  ])("%j: %s", (record, passes) => {
    const classes = { ...ASPRS_CLASSES, 7: { ...ASPRS_CLASSES[7], show: false } };
    expect(passesFilter(record, filter, { classes })).toBe(passes);
  });
});

describe("the visible octree", () => {
  const node = (
    depth: number,
    x: number,
    y: number,
    z: number,
    parts: Partial<VisibleNode> = {},
  ): VisibleNode => ({
    key: { depth, x, y, z },
    points: 10_000,
    count: 10_000,
    leaf: false,
    spacing: 1 / 2 ** depth,
    box: [0, 0, 0, 100, 100, 10],
    ...parts,
  });

  it("is laid breadth first as the thesis draws it (fig. 4.16)", () => {
    // r, r3, r4, r30, r43: octants have x in bit 0, y in bit 1, z in bit 2.
    const nodes = [node(0, 0, 0, 0), node(1, 1, 1, 0), node(1, 0, 0, 1), node(2, 2, 2, 0), node(2, 1, 1, 2)];
    const { texture, indices } = encodeVisibleOctree(nodes);
    expect([...indices]).toEqual([0, 1, 2, 3, 4]);
    const texel = (index: number) => [...texture.subarray(4 * index, 4 * index + 3)];
    expect(texel(0)).toEqual([0b11000, 1, 0]);
    expect(texel(1)).toEqual([0b00000001, 2, 0]);
    expect(texel(2)).toEqual([0b00001000, 2, 0]);
    expect([texel(3), texel(4)]).toEqual([
      [0, 0, 0],
      [0, 0, 0],
    ]);
  });

  it("holds together where an ancestor is not drawn", () => {
    const { texture, indices } = encodeVisibleOctree([node(0, 0, 0, 0), node(3, 0, 0, 0)]);
    expect([...indices]).toEqual([0, 3]);
    expect(texture[4 * 2]).toBe(1);
  });

  it("says how far the points of a node lie apart, in sixteenths of a doubling of its level's spacing", () => {
    const { texture } = encodeVisibleOctree([node(0, 0, 0, 0, { count: 2500 }), node(1, 0, 0, 0)]);
    expect([texture[3], texture[7]]).toEqual([128 + 16, 128]);
  });
});

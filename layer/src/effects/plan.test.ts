import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { EFFECT_NAMES, EFFECTS, type EffectName, type PointCloudStyle } from "./catalogue/index.js";
import { ASPRS_CLASSES } from "./declaration/classes.js";
import type { SceneFacts } from "./declaration/facts.js";
import { checkForced, type Forced, planEffects, widestPoint } from "./plan.js";
import { richFacts, styleOf } from "./scene.fixture.js";

const THRESHOLD = 0.01;
const HELD = 0.8 * THRESHOLD;
const style = styleOf({ eyeDomeLighting: "auto" });
const none: ReadonlySet<EffectName> = new Set();

/** The row of an automatic effect whose magnitude is measured, and what runs. */
function planAt(silhouettes: number, before: ReadonlySet<EffectName>) {
  const { active, ledger } = planEffects(style, richFacts({ silhouettes }), {}, before);
  return { active, row: ledger.find(({ effect }) => effect === "eyeDomeLighting")! };
}

/** Whether the effect runs in each of the frames that follow one another. */
function runs(magnitudes: readonly number[], began: boolean): boolean[] {
  let before: ReadonlySet<EffectName> = began ? new Set(["eyeDomeLighting"]) : none;
  return magnitudes.map((magnitude) => {
    const { active } = planAt(magnitude, before);
    before = active;
    return active.has("eyeDomeLighting");
  });
}

const share = fc.double({ min: 0, max: 3 * THRESHOLD, noNaN: true });
const between = fc.double({ min: HELD, max: THRESHOLD, maxExcluded: true, noNaN: true });

describe("an effect around its threshold", () => {
  it("stays as it was between the two, and the ledger says so", () => {
    fc.assert(
      fc.property(fc.array(between, { maxLength: 20 }), fc.boolean(), (magnitudes, began) => {
        expect(new Set([began, ...runs(magnitudes, began)])).toEqual(new Set([began]));
      }),
    );
    expect(planAt(0.009, new Set(["eyeDomeLighting"])).row.why).toContain("stays on down to 0.8");
    expect(planAt(0.009, none).row.why).toContain("would not show");
    expect(planAt(0.02, new Set(["eyeDomeLighting"])).row.why).not.toContain("stays on");
  });

  it("turns at most once while its magnitude changes by less than the band", () => {
    const narrow = fc.record({
      least: share,
      parts: fc.array(fc.double({ min: 0, max: 0.999 * (THRESHOLD - HELD), noNaN: true }), { maxLength: 30 }),
      began: fc.boolean(),
    });
    fc.assert(
      fc.property(narrow, ({ least, parts, began }) => {
        const states = [
          began,
          ...runs(
            parts.map((part) => least + part),
            began,
          ),
        ];
        const turns = states.filter((state, at) => at > 0 && state !== states[at - 1]);
        expect(turns.length).toBeLessThanOrEqual(1);
      }),
    );
  });

  it("runs at all greater magnitudes too, and where it ran before wherever it would start", () => {
    fc.assert(
      fc.property(share, share, fc.boolean(), (a, b, ran) => {
        const before = ran ? new Set<EffectName>(["eyeDomeLighting"]) : none;
        const at = (magnitude: number, from = before) => planAt(magnitude, from).row.active;
        expect(at(Math.max(a, b)) || !at(Math.min(a, b))).toBe(true);
        expect(at(a, new Set(["eyeDomeLighting"])) || !at(a, none)).toBe(true);
        expect(planAt(a, before).row.active).toBe(a >= THRESHOLD || (ran && a >= HELD));
      }),
    );
  });

  it("is on or off as it is forced, whatever ran before", () => {
    const facts = richFacts({ silhouettes: 0.009 });
    const off = planEffects(style, facts, { eyeDomeLighting: false }, new Set(["eyeDomeLighting"]));
    expect(off.active.has("eyeDomeLighting")).toBe(false);
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
    expect(has("splats", { splats: "auto", pointSize: 3 }, near)).toBe(false);
    expect(has("splats", { splats: "auto", pointSize: 5 }, near)).toBe(true);
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
});

describe("the catalogue", () => {
  it("has each effect once, and each word of a style", () => {
    expect(new Set(EFFECT_NAMES).size).toBe(EFFECTS.length);
    const words = EFFECTS.flatMap(({ words }) =>
      Object.entries(words ?? {}).map(([key, word]) => `${key} ${word}`),
    );
    expect(words.sort()).toEqual(
      ["color levelOfDetail", "color rgb", "shape disc", "shape paraboloid"].concat([
        "size adaptive",
        "size attenuated",
        "size fixed",
      ]),
    );
  });

  it("draws every word for sizes, and knows how wide its points can be", () => {
    const width = (style: Partial<PointCloudStyle>) => widestPoint(styleOf(style));
    expect(width({ size: "fixed", pointSize: 7 })).toBe(7);
    expect(width({ size: "attenuated", maximumSize: 30 })).toBe(30);
    expect(width({ size: "adaptive", maximumSize: 31 })).toBe(31);
  });
});

describe("a blend", () => {
  const planOf = (share: number, before: ReadonlySet<EffectName> = none) =>
    planEffects(styleOf({ blend: { color: "intensity", share } }), richFacts(), {}, before);

  it("runs with two colourings, and never with one, whatever ran before", () => {
    const least = 0.5 / 255;
    const shares = [0, 0.9 * least, least, 0.5, 1 - least, 1 - 0.9 * least, 1];
    for (const share of shares) {
      for (const before of [none, new Set<EffectName>(["blend", "gradient", "rgb"])]) {
        const { active, scene } = planOf(share, before);
        expect([share, active.has("blend")]).toEqual([share, scene.colourings.length === 2]);
        expect(scene.colourings.reduce((sum, colouring) => sum + colouring.share, 0)).toBe(1);
      }
    }
    expect(planOf(0.5).active.has("blend")).toBe(true);
  });
});

describe("what is forced", () => {
  const check = (forced: unknown) => checkForced(forced as Forced, "a.copc.laz");

  it("is copied and frozen", () => {
    const given = { eyeDomeLighting: true, clip: false, disc: undefined };
    expect(check(given)).toEqual(given);
    expect(Object.isFrozen(check(given))).toBe(true);
    expect(Object.isFrozen(given)).toBe(false);
  });

  it.each<[unknown, string]>([
    [{ eyeDomeLightning: true }, 'unknown effect "eyeDomeLightning". Did you mean "eyeDomeLighting"?'],
    [{ constructor: true }, 'unknown effect "constructor"'],
    [JSON.parse('{ "__proto__": true }'), 'unknown effect "__proto__"'],
    [{ disc: "yes" }, 'forced.disc cannot be "yes". Use true or false'],
    [{ disc: 1 }, "forced.disc cannot be 1"],
    [{ rgb: true }, "rgb cannot be forced, it follows from the style"],
    [{ gradient: false }, "gradient cannot be forced, it follows from the style"],
    [{ blend: false }, "blend cannot be forced, it follows from the style"],
    [{ filter: true }, "filter cannot be forced on"],
    [{ clip: true }, "clip cannot be forced on"],
    [{ highlight: true }, "highlight cannot be forced on"],
    [null, "forced cannot be null"],
    [["disc"], "forced cannot be an array of 1"],
  ])("is STYLE_FORCED for %j", (forced, message) => {
    expect(() => check(forced)).toThrow(
      expect.objectContaining({ code: "STYLE_FORCED", file: "a.copc.laz" }),
    );
    expect(() => check(forced)).toThrow(message);
  });
});

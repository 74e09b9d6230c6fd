import fc from "fast-check";
import { describe, expect, it } from "vitest";
import type { EffectName } from "./effect-plan.js";
import { planEffects } from "./plan.js";
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

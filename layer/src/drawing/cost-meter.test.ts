import { describe, expect, it } from "vitest";
import type { EffectName, LedgerRow } from "../effects/index.js";
import { CostMeter } from "./cost-meter.js";

const planOf = (...names: EffectName[]) => ({
  active: new Set(names),
  ledger: (["fixedSize", "adaptiveSize", "disc", "eyeDomeLighting"] as const).map(
    (effect): LedgerRow => ({
      effect,
      magnitude: 1,
      unit: "px",
      threshold: 0,
      active: names.includes(effect),
      why: "",
      source: "",
      cost: undefined,
    }),
  ),
});
/** Notes as many frames as it takes until they count. */
function note(
  meter: CostMeter,
  plan: ReturnType<typeof planOf>,
  milliseconds: number,
  by: "timer query" | "frame difference",
  points = 1_000_000,
): void {
  for (let frame = 0; frame < 12; frame++) meter.note({ plan, points, milliseconds, by });
}
const costs = (meter: CostMeter, ...names: EffectName[]) =>
  Object.fromEntries(meter.complete(planOf(...names)).map(({ effect, cost }) => [effect, cost?.value]));

describe("CostMeter", () => {
  it("tells what a set of effects takes more than the same without one of them", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 4, "timer query");
    note(meter, planOf("fixedSize", "disc"), 5, "timer query");
    note(meter, planOf("fixedSize", "disc", "eyeDomeLighting"), 8, "timer query");
    expect(costs(meter, "fixedSize", "disc", "eyeDomeLighting")).toEqual({
      fixedSize: undefined,
      adaptiveSize: undefined,
      disc: undefined,
      eyeDomeLighting: 3,
    });
    expect(costs(meter, "fixedSize", "disc").disc).toBe(1);
  });

  it("holds an effect against the one that was in its place", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 4, "frame difference");
    note(meter, planOf("adaptiveSize"), 6, "frame difference");
    const [row] = meter.complete(planOf("adaptiveSize")).filter(({ effect }) => effect === "adaptiveSize");
    expect(row?.cost).toEqual({ value: 2, unit: "ms per frame", by: "frame difference" });
  });

  it("does not compare what was measured in two ways", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 16, "frame difference");
    note(meter, planOf("fixedSize", "disc"), 5, "timer query");
    expect(costs(meter, "fixedSize", "disc").disc).toBeUndefined();
  });

  it("says nothing of what does not run", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 4, "timer query");
    note(meter, planOf("fixedSize", "disc"), 5, "timer query");
    expect(costs(meter, "fixedSize").disc).toBeUndefined();
  });

  it("holds a clip against frames of as many points, and not against those that it spares", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 10, "timer query", 1_000_000);
    note(meter, planOf("fixedSize", "disc"), 6, "timer query", 500_000);
    expect(costs(meter, "fixedSize", "disc").disc).toBeUndefined();
    note(meter, planOf("fixedSize"), 5, "timer query", 510_000);
    expect(costs(meter, "fixedSize", "disc").disc).toBeCloseTo(1, 9);
    // More points since: what was measured last without a counterpart does not take that away.
    note(meter, planOf("fixedSize", "disc"), 30, "timer query", 3_000_000);
    expect(costs(meter, "fixedSize", "disc").disc).toBeCloseTo(1, 9);
  });

  it("leaves out the frames right after a change, in which programs are made and points are uploaded", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 4, "frame difference");
    const plan = planOf("fixedSize", "disc");
    for (const milliseconds of [900, 300, 90, 30, 9, 9, 9, 9]) {
      meter.note({ plan, points: 1_000_000, milliseconds, by: "frame difference" });
    }
    expect(costs(meter, "fixedSize", "disc").disc).toBeUndefined();
    meter.note({ plan, points: 1_000_000, milliseconds: 9, by: "frame difference" });
    expect(costs(meter, "fixedSize", "disc").disc).toBe(5);
  });

  it("says that an effect takes less where it does", () => {
    const meter = new CostMeter();
    note(meter, planOf("fixedSize"), 5, "timer query");
    note(meter, planOf("fixedSize", "disc"), 4, "timer query");
    expect(costs(meter, "fixedSize", "disc").disc).toBe(-1);
  });
});

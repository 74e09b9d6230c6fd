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
const costs = (meter: CostMeter, ...names: EffectName[]) =>
  Object.fromEntries(meter.complete(planOf(...names)).map(({ effect, cost }) => [effect, cost?.value]));

describe("CostMeter", () => {
  it("tells what a set of effects takes more than the same without one of them", () => {
    const meter = new CostMeter();
    meter.note(planOf("fixedSize"), 4, "timer query");
    meter.note(planOf("fixedSize", "disc"), 5, "timer query");
    meter.note(planOf("fixedSize", "disc", "eyeDomeLighting"), 8, "timer query");
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
    meter.note(planOf("fixedSize"), 4, "frame difference");
    meter.note(planOf("adaptiveSize"), 6, "frame difference");
    const [row] = meter.complete(planOf("adaptiveSize")).filter(({ effect }) => effect === "adaptiveSize");
    expect(row?.cost).toEqual({ value: 2, unit: "ms per frame", by: "frame difference" });
  });

  it("does not compare what was measured in two ways", () => {
    const meter = new CostMeter();
    meter.note(planOf("fixedSize"), 16, "frame difference");
    meter.note(planOf("fixedSize", "disc"), 5, "timer query");
    expect(costs(meter, "fixedSize", "disc").disc).toBeUndefined();
  });

  it("says nothing of what does not run", () => {
    const meter = new CostMeter();
    meter.note(planOf("fixedSize"), 4, "timer query");
    meter.note(planOf("fixedSize", "disc"), 5, "timer query");
    expect(costs(meter, "fixedSize").disc).toBeUndefined();
  });
});

import type { EffectName, EffectPlan, LedgerRow, MeasuredCost } from "../effects/index.js";

/** Share of a new value in the running mean. */
const SHARE = 0.1;

/** Sets of effects whose cost is remembered. */
const REMEMBERED = 32;

type How = "timer query" | "frame difference";

interface Entry {
  readonly active: ReadonlySet<EffectName>;
  milliseconds: number;
  readonly by: How;
}

/**
 * What effects cost, from frames with and without them: each set of effects that was drawn has its milliseconds per
 * frame, and an effect costs what its set takes more than the same set without it, or with one other in its place.
 */
export class CostMeter {
  readonly #entries = new Map<string, Entry>();

  /** Takes a frame's milliseconds: of the GPU where it can be asked, else from frame to frame. */
  note({ active }: Pick<EffectPlan, "active">, milliseconds: number, by: How): void {
    const key = `${by}|${[...active].sort().join("+")}`;
    const entry = this.#entries.get(key);
    if (entry) {
      entry.milliseconds += SHARE * (milliseconds - entry.milliseconds);
      return;
    }
    this.#entries.set(key, { active, milliseconds, by });
    const [oldest] = this.#entries.keys();
    if (this.#entries.size > REMEMBERED && oldest !== undefined) this.#entries.delete(oldest);
  }

  /** Rows of a ledger with what their effects were measured to cost. */
  complete({ active, ledger }: Pick<EffectPlan, "active" | "ledger">): LedgerRow[] {
    return ledger.map((row) => {
      const name = row.effect as EffectName;
      return row.active && active.has(name) ? { ...row, cost: row.cost ?? this.#cost(name, active) } : row;
    });
  }

  #cost(effect: EffectName, active: ReadonlySet<EffectName>): MeasuredCost | undefined {
    const entries = [...this.#entries.values()];
    const withIt = entries.findLast((entry) => sameSet(entry.active, active));
    if (!withIt) return undefined;
    const others = [...active].filter((name) => name !== effect);
    const without = entries
      .filter(
        ({ active: set, by }) =>
          by === withIt.by && !set.has(effect) && others.every((name) => set.has(name)),
      )
      .filter(({ active: set }) => set.size - others.length <= 1)
      .sort((a, b) => a.active.size - b.active.size)[0];
    if (!without) return undefined;
    return { value: withIt.milliseconds - without.milliseconds, unit: "ms per frame", by: withIt.by };
  }
}

function sameSet(a: ReadonlySet<EffectName>, b: ReadonlySet<EffectName>): boolean {
  return a.size === b.size && [...a].every((name) => b.has(name));
}

import type { EffectName, EffectPlan, LedgerRow, MeasuredCost } from "../effects/index.js";

/** Share of a new value in the running mean. */
const SHARE = 0.1;

/** Sets of effects, each with numbers of points, whose cost is remembered. */
const REMEMBERED = 128;

/** Frames of one set and number of points after which a frame's milliseconds are its own: programs, uploads and means. */
const STEADY = 8;

/** Numbers of points count as the same within a quarter of a doubling. */
const CLASSES_PER_DOUBLING = 4;

type How = "timer query" | "frame difference";

/** A frame that was drawn. */
interface Frame {
  readonly plan: Pick<EffectPlan, "active">;
  readonly points: number;
  /** Of the GPU where it can be asked, else from frame to frame. */
  readonly milliseconds: number;
  readonly by: How;
}

interface Entry {
  readonly active: ReadonlySet<EffectName>;
  readonly amount: number;
  readonly by: How;
  readonly milliseconds: number;
}

/**
 * What effects cost, from frames with and without them that drew about as many points: a clip that leaves half of them
 * out is compared with frames of half as many, and not with frames of all points. Each set of effects has its
 * milliseconds per frame, and an effect costs what its set takes more than the same set without it, or with one other in
 * its place.
 */
export class CostMeter {
  readonly #entries = new Map<string, Entry>();
  #last = "";
  #steady = 0;

  note({ plan: { active }, points, milliseconds, by }: Frame): void {
    const amount = Math.round(CLASSES_PER_DOUBLING * Math.log2(Math.max(1, points)));
    const key = `${by}|${amount}|${[...active].sort().join("+")}`;
    this.#steady = key === this.#last ? this.#steady + 1 : 0;
    this.#last = key;
    if (this.#steady < STEADY) return;
    const entry = this.#entries.get(key);
    // The one measured last stands last.
    this.#entries.delete(key);
    const before = entry?.milliseconds ?? milliseconds;
    const mean = before + SHARE * (milliseconds - before);
    this.#entries.set(key, { active, amount, by, milliseconds: mean });
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

  /** Of the number of points measured last for which there are frames of both kinds. */
  #cost(effect: EffectName, active: ReadonlySet<EffectName>): MeasuredCost | undefined {
    const entries = [...this.#entries.values()].reverse();
    const others = [...active].filter((name) => name !== effect);
    const without = entries.filter(
      ({ active: set }) =>
        !set.has(effect) && others.every((name) => set.has(name)) && set.size - others.length <= 1,
    );
    for (const { milliseconds, amount, by } of entries.filter((entry) => sameSet(entry.active, active))) {
      const [nearest] = without
        .filter((entry) => entry.amount === amount && entry.by === by)
        .sort((a, b) => a.active.size - b.active.size);
      if (nearest) return { value: milliseconds - nearest.milliseconds, unit: "ms per frame", by };
    }
    return undefined;
  }
}

function sameSet(a: ReadonlySet<EffectName>, b: ReadonlySet<EffectName>): boolean {
  return a.size === b.size && [...a].every((name) => b.has(name));
}

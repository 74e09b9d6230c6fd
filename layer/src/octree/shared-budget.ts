import { type Kind, number, optionPlace, SHARED, shared, some } from "../options/index.js";
import { ByteLedger } from "./byte-ledger.js";
import { countsAt, type Demand, pointsAt, thresholdFor } from "./share.js";

/** What several clouds of one scene have together. */
export interface SharedBudgetOptions {
  /** Most points drawn at once. Default: 1,000,000. */
  readonly points?: number | undefined;
  /** Bytes of decoded nodes that are kept. Default: 268,435,456. */
  readonly cpuBytes?: number | undefined;
  /** Bytes on the GPU. Default: 536,870,912. */
  readonly gpuBytes?: number | undefined;
}

/** Points that a view may draw of each node of its demand. */
export interface Grant {
  readonly counts: number[];
  /** Spacing on the screen that the budget allows, pixels; 0 where it is the screen-space error that set the counts. */
  readonly threshold: number;
}

interface Share {
  readonly demand: Demand;
  readonly points: number;
  readonly threshold: number;
}

/** Name of the class, and version of what is internal here (see {@link SHARED}). */
const MARK = "SharedBudget 2";

const amount = number(0);
const OPTIONS = some<SharedBudgetOptions>({ points: amount, cpuBytes: amount, gpuBytes: amount });

/** A budget of 0 and more. */
const held = (value: number) => (value > 0 ? value : 0);

/**
 * One budget for several clouds, as if they were one octree: all are drawn to the same spacing on the screen, that at
 * which their points together keep the budget. Each view asks once per frame; what the others asked for last counts
 * for them. The sum never passes the budget: a view that comes anew, or grows, gets its full part once the others
 * have asked again ({@link balanced}).
 */
export class SharedBudget {
  /** @internal */
  readonly [SHARED] = MARK;
  /** Bytes of decoded nodes of all clouds. @internal */
  readonly cpu: ByteLedger;
  /** Bytes on the GPU of all layers; whoever uploads tells it. @internal */
  readonly gpu: ByteLedger;
  readonly #shares = new Map<object, Share>();
  readonly #listeners = new Set<() => void>();
  #points: number;
  #threshold = 0;

  /** @throws StyleError STYLE_OPTION for an option that there is not, or that is no number from 0 on */
  constructor(options: SharedBudgetOptions = {}) {
    const { points, cpuBytes, gpuBytes } = OPTIONS.read(options, optionPlace("options", "SharedBudget"));
    this.#points = points ?? 1_000_000;
    this.cpu = new ByteLedger(cpuBytes ?? 268_435_456);
    this.gpu = new ByteLedger(gpuBytes ?? 536_870_912);
  }

  /** Most points drawn at once, from 0 to Infinity. @throws StyleError STYLE_OPTION */
  get points(): number {
    return this.#points;
  }

  set points(points: number) {
    this.#points = amount.read(points, optionPlace("points", "SharedBudget"));
    this.#tell();
  }

  /** Points given out, never above {@link points} as it was when they were given. */
  get granted(): number {
    let points = 0;
    for (const share of this.#shares.values()) points += share.points;
    return points;
  }

  /** False while a view has not yet had the part that is due to it now: one more frame will give it. */
  get balanced(): boolean {
    for (const { threshold } of this.#shares.values()) {
      if (Math.abs(threshold - this.#threshold) > 1e-3 * this.#threshold) return false;
    }
    return true;
  }

  /**
   * Calls back when the parts that are due are others than before: a view that draws no frame of itself then has to ask
   * again, so that the others get theirs.
   * @returns what ends that
   * @internal
   */
  onChange(listener: () => void): () => void {
    this.#listeners.add(listener);
    return () => this.#listeners.delete(listener);
  }

  /**
   * Gives a view its part.
   * @param viewer stands for the view; the same object in each call
   * @param limit points that this view may have at most, whatever the budget leaves
   * @internal
   */
  grant(viewer: object, demand: Demand, limit: number): Grant {
    this.#shares.delete(viewer);
    const left = held(this.points - this.granted);
    const demands = [...this.#shares.values()].map((share) => share.demand);
    this.#threshold = thresholdFor([...demands, demand], this.points);
    // What rounding leaves goes to whoever asks last; a whole number of points is due to each.
    const due = this.#threshold === 0 ? left : Math.ceil(pointsAt(demand, this.#threshold));
    const most = Math.min(left, due, held(limit));
    const threshold = Math.max(this.#threshold, thresholdFor([demand], most));
    const counts = countsAt(demand, threshold, most);
    const points = counts.reduce((sum, count) => sum + count, 0);
    // A view held back by its own limit is not waiting for the others, nor is one short of what rounding took.
    const waits = most === left && most < due - demands.length;
    this.#shares.set(viewer, { demand, points, threshold: waits ? threshold : this.#threshold });
    if (!this.balanced) this.#tell();
    return { counts, threshold };
  }

  /** A view ends: its points are free for the others. @internal */
  release(viewer: object): void {
    this.#shares.delete(viewer);
    const demands = [...this.#shares.values()].map((share) => share.demand);
    this.#threshold = thresholdFor(demands, this.points);
    if (!this.balanced) this.#tell();
  }

  #tell(): void {
    for (const listener of this.#listeners) listener();
  }
}

/** What an option of a budget may be. */
export const BUDGET_OPTION: Kind<SharedBudget> = shared(MARK);

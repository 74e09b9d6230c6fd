import { EFFECTS } from "./catalogue.js";
import { colouringsOf } from "./colouring.js";
import type { Effect } from "./effect.js";
import type { Colouring, EffectName, EffectPlan, LedgerRow } from "./effect-plan.js";
import type { SceneFacts } from "./facts.js";
import { hidesClasses } from "./filter.js";
import { placingRows } from "./placing-ledger.js";
import type { Scene } from "./scene.js";
import { eyeDomeOf, type PointCloudStyle } from "./style.js";

/** Effects that the user forces on or off, whatever their magnitude. */
export type Forced = Readonly<Partial<Record<EffectName, boolean>>>;

/** What else a program depends on. */
type Traits = Pick<EffectPlan, "colourings" | "filters" | "neighbours">;

/** Effects that leave no room for one another: the first that runs is the one. */
const ONE_OF: readonly (readonly EffectName[])[] = [
  ["adaptiveSize", "attenuatedSize", "fixedSize"],
  ["splats", "paraboloid", "disc"],
];

/** Effects that only make sense where the style has what they show. */
const COLOURS: Readonly<Partial<Record<EffectName, Colouring["kind"]>>> = {
  ownColour: "own",
  gradient: "scalar",
  classification: "class",
  levelOfDetail: "level",
};

/** Share of its threshold down to which an effect that runs goes on, so that none flickers that hovers around it. */
const HOLD = 0.8;

const NONE: ReadonlySet<EffectName> = new Set();

/**
 * The effects that a scene calls for: each that is wished for and whose magnitude reaches its threshold. Two scenes with
 * the same set have the same key, and can share their programs.
 * @param before what ran in the last frame: it goes on down to {@link HOLD} of its threshold
 */
export function planEffects(
  style: PointCloudStyle,
  facts: SceneFacts,
  forced: Forced = {},
  before = NONE,
): EffectPlan {
  const scene: Scene = { style, facts };
  const colourings = colouringsOf(scene);
  const rows = new Map<EffectName, LedgerRow>(
    EFFECTS.map((effect) => {
      const { name } = effect;
      return [name, decide(effect, scene, forcible(name, forced), before.has(name))];
    }),
  );
  settleBlend(rows, colourings);
  for (const group of ONE_OF) keepOne(rows, group, forced);
  settleSize(rows, style);
  const active = new Set(
    [...rows.values()].filter((row) => row.active).map((row) => row.effect as EffectName),
  );
  const filtering = active.has("filter");
  const traits: Traits = {
    colourings,
    filters: {
      classes: filtering && hidesClasses(style, facts.filter),
      returns: filtering && facts.filter?.returns !== undefined,
      ranges: filtering ? Object.keys(facts.filter?.ranges ?? {}) : [],
      filter: facts.filter,
    },
    neighbours: eyeDomeOf(style).neighbours,
  };
  const ledger = [...rows.values(), ...placingRows(facts)];
  return { active, ledger, key: keyOf(active, traits), ...traits };
}

/** Whether Eye-Dome Lighting is left to how much depth steps in the picture, which then has to be measured. */
export function asksForSilhouettes({ eyeDomeLighting }: PointCloudStyle, forced: Forced): boolean {
  return eyeDomeLighting === "auto" && forced.eyeDomeLighting === undefined;
}

/** The plan for nodes that no volume touches: the same without the effects of volumes. */
export function withoutClips(plan: EffectPlan): EffectPlan {
  if (!plan.active.has("clip") && !plan.active.has("highlight")) return plan;
  const active = new Set([...plan.active].filter((name) => name !== "clip" && name !== "highlight"));
  return { ...plan, active, key: keyOf(active, plan) };
}

function keyOf(active: ReadonlySet<EffectName>, { colourings, filters, neighbours }: Traits): string {
  const { classes, returns, ranges } = filters;
  return [
    [...active].join("+"),
    colourings.map(({ kind, column }) => `${kind}:${column ?? ""}`).join(","),
    [
      ...(classes ? ["classes"] : []),
      ...(returns ? ["returns"] : []),
      ...ranges.map((name) => `:${name}`),
    ].join(","),
    active.has("eyeDomeLighting") ? neighbours : "",
  ].join("|");
}

/** What colours show, a blend and a filter follow from the style; forcing them would leave nothing to draw with. */
function forcible(name: EffectName, forced: Forced): boolean | undefined {
  return name in COLOURS || name === "blend" || (name === "filter" && forced.filter)
    ? undefined
    : forced[name];
}

function decide(effect: Effect, scene: Scene, forced: boolean | undefined, ran: boolean): LedgerRow {
  const { name, unit, threshold, source } = effect;
  const magnitude = effect.magnitude(scene);
  const row = { effect: name, magnitude, unit, threshold, source, cost: undefined };
  if (forced !== undefined) return { ...row, active: forced, why: `forced ${forced ? "on" : "off"}` };
  const wish = effect.wish(scene);
  if (wish.kind === "off") return { ...row, active: false, why: wish.why };
  if (wish.kind === "forced") return { ...row, active: true, why: `forced: ${wish.why}` };
  if (magnitude >= threshold) return { ...row, active: true, why: wish.why };
  if (ran && magnitude >= HOLD * threshold) {
    return {
      ...row,
      active: true,
      why: `${wish.why}; once on, it stays on down to ${HOLD} of the threshold`,
    };
  }
  return { ...row, active: false, why: `${wish.why}, but it would not show` };
}

/** A blend whose lesser share shows nothing has one colouring left, and is none. */
function settleBlend(rows: Map<EffectName, LedgerRow>, colourings: readonly Colouring[]): void {
  if (colourings.length === 2) turn(rows, "blend", true);
}

/** Of effects that exclude each other, the one forced on, else the first that runs. */
function keepOne(rows: Map<EffectName, LedgerRow>, group: readonly EffectName[], forced: Forced): void {
  const running = group.filter((name) => rows.get(name)!.active);
  const kept = running.find((name) => forced[name]) ?? running[0];
  for (const name of running) {
    if (name !== kept) turn(rows, name, false, `${kept} is drawn instead`);
  }
}

/** A point has a size: where adaptive sizes would not show, one size on the ground gives the same picture. */
function settleSize(rows: Map<EffectName, LedgerRow>, style: PointCloudStyle): void {
  if (ONE_OF[0].some((name) => rows.get(name)!.active)) return;
  if (style.size === "fixed") turn(rows, "fixedSize", true, "a point needs a size");
  else turn(rows, "attenuatedSize", true, "one size on the ground shows the same as adaptive sizes");
}

function turn(rows: Map<EffectName, LedgerRow>, name: EffectName, active: boolean, why?: string): void {
  const row = rows.get(name)!;
  rows.set(name, { ...row, active, why: why ?? row.why });
}

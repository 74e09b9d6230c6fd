import {
  entriesOf,
  flag,
  frozen,
  inside,
  instead,
  optionPlace,
  type Place,
  shown,
} from "../options/index.js";
import { type AnyEffect, EFFECTS, type EffectName, type PointCloudStyle } from "./catalogue/index.js";
import { LEAST_SHARE } from "./declaration/colouring.js";
import type { Colouring, Scene } from "./declaration/effect.js";
import type { SceneFacts } from "./declaration/facts.js";
import type { EffectPlan, LedgerRow } from "./effect-plan.js";
import { placingRows } from "./placing-ledger.js";

/** Effects that the user forces on or off, whatever their magnitude. */
export type Forced = Readonly<Partial<Record<EffectName, boolean | undefined>>>;

type Rows = Map<EffectName, LedgerRow>;

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
  const scene = sceneOf(style, facts);
  const rows: Rows = new Map(
    EFFECTS.map((effect) => [
      effect.name,
      decide(effect, scene, forcedOf(effect, forced), before.has(effect.name)),
    ]),
  );
  for (const group of ["sizes", "shapes"] as const) keepOne(rows, group, style, forced);
  const running = EFFECTS.filter(({ name }) => rows.get(name)!.active);
  const active = new Set(running.map(({ name }) => name));
  const variants = new Map(running.map((effect) => [effect.name, effect.variant?.(scene)] as const));
  const ledger = [...rows.values(), ...placingRows(facts)];
  return { active, ledger, scene, variants, key: keyOf(scene, active, variants) };
}

/** Whether Eye-Dome Lighting is left to how much depth steps in the picture, which then has to be measured. */
export function asksForSilhouettes(
  { eyeDomeLighting }: Pick<PointCloudStyle, "eyeDomeLighting">,
  forced: Forced,
): boolean {
  return eyeDomeLighting === "auto" && forced.eyeDomeLighting === undefined;
}

/** The plan for nodes that no volume touches: the same without the effects of volumes. */
export function withoutClips(plan: EffectPlan): EffectPlan {
  const { scene, variants } = plan;
  const clips = EFFECTS.filter(({ nodeTexture }) => nodeTexture === "clips").map(({ name }) => name);
  if (!clips.some((name) => plan.active.has(name))) return plan;
  const active = new Set([...plan.active].filter((name) => !clips.includes(name)));
  return { ...plan, active, key: keyOf(scene, active, variants) };
}

/**
 * Effects to be forced, checked and copied.
 * @param file whose layer it is, for errors
 * @throws StyleError STYLE_FORCED for what is no effect, cannot be forced so, or is neither true nor false
 */
export function checkForced(forced: Forced, file: string): Forced {
  const place: Place = optionPlace("forced", file, "STYLE_FORCED");
  const names = EFFECTS.filter(({ forcible }) => forcible !== "never").map(({ name }) => name);
  const entries = entriesOf(forced, undefined, place, "an object of effects, each true or false");
  for (const [name, on] of entries) {
    const effect = EFFECTS.find((known) => known.name === name);
    if (!effect) place.refuse(`unknown effect ${shown(name)}`, instead(name, names));
    if (on === undefined) continue;
    if (effect.forcible === "never") {
      place.refuse(`${name} cannot be forced, it follows from the style`, instead(name, names));
    }
    if (flag.read(on, inside(place, `.${name}`)) && effect.forcible === "off") {
      place.refuse(
        `${name} cannot be forced on: without volumes or a filter it has nothing to do`,
        "use false",
      );
    }
  }
  return frozen(Object.fromEntries(entries));
}

/** A style and the frame that it is drawn in, with what follows from both. */
function sceneOf(style: PointCloudStyle, facts: SceneFacts): Scene<PointCloudStyle> {
  const scene = { style, facts };
  const { widths } = sizeOf(style);
  const width = widths.widest(scene);
  return { ...scene, colourings: colouringsOf(scene), width, overlap: widths.overlap(width, scene) };
}

/** Greatest width of a point of a style, CSS pixels. */
export function widestPoint(style: PointCloudStyle): number {
  return sizeOf(style).widths.limit(style);
}

/** The effect that a style's word for sizes asks for. */
function sizeOf({ size }: PointCloudStyle) {
  for (const { words, widths } of EFFECTS) {
    if (widths && words?.size === size) return { widths };
  }
  throw new TypeError(`no effect draws ${size} sizes`);
}

/** Where the colours of a style come from: one colouring, or two where a blend shows both. */
export function colouringsOf({
  style,
  facts,
}: {
  readonly style: PointCloudStyle;
  readonly facts: Pick<SceneFacts, "attributes">;
}): Colouring[] {
  const share = style.blend?.share ?? 0;
  const first = 1 - share >= LEAST_SHARE ? [style.color] : [];
  const second = style.blend && share >= LEAST_SHARE ? [style.blend.color] : [];
  const colors = [...first, ...second];
  return colors.map((color, index) => {
    const attribute = facts.attributes.find(({ name }) => name === color);
    const effect = EFFECTS.find(({ colours }) => colours?.shows(color, attribute?.kind));
    const { name, colours: { toned, smooth } = {} } = effect ?? { name: "gradient" };
    return {
      effect: name,
      column: attribute?.name,
      share: colors.length === 1 ? 1 : index === 0 ? 1 - share : share,
      ...(toned && { toned }),
      ...(smooth && { smooth }),
    };
  });
}

function keyOf(
  { colourings }: Scene<PointCloudStyle>,
  active: ReadonlySet<EffectName>,
  variants: EffectPlan["variants"],
): string {
  const effects = [...active].map((name) => [name, variants.get(name)]);
  return JSON.stringify([effects, colourings.map(({ effect, column }) => [effect, column])]);
}

/** What the user says of an effect, as far as it can be forced: one that has nothing to draw with is never forced on. */
function forcedOf({ name, forcible }: AnyEffect, forced: Forced): boolean | undefined {
  const on = forced[name];
  return forcible === "never" || (forcible === "off" && on) ? undefined : on;
}

function decide(
  effect: AnyEffect,
  scene: Scene<PointCloudStyle>,
  forced: boolean | undefined,
  ran: boolean,
): LedgerRow {
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

/** Of effects that exclude each other, the one forced on, else the last of the catalogue that runs, or its last resort. */
function keepOne(rows: Rows, group: "sizes" | "shapes", style: PointCloudStyle, forced: Forced): void {
  const members = EFFECTS.filter((effect) => effect.group === group).reverse();
  const running = members.filter(({ name }) => rows.get(name)!.active);
  const kept = running.find(({ name }) => forced[name]) ?? running[0];
  for (const { name } of running) {
    if (name !== kept.name) turn(rows, name, false, `${kept.name} is drawn instead`);
  }
  if (kept) return;
  const last = members.find((effect) => effect.lastResort?.(style) !== undefined);
  if (last) turn(rows, last.name, true, last.lastResort?.(style) ?? "");
}

function turn(rows: Rows, name: EffectName, active: boolean, why: string): void {
  rows.set(name, { ...rows.get(name)!, active, why });
}

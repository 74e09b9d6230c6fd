import { median } from "./rendering-figures.mjs";

/** From where the scan is looked at: the stadium and what lies around it, the distance in metres. */
export const POSE = { at: [637_290, 851_210, 430], heading: 30, pitch: -40, range: 400 };

/** Frames of each look that are timed, in turn with those of the other. */
export const FRAMES = { effects: 11, sweeps: 5 };

/** The default size, and the one that closes what lies between points of any level. */
const FIXED = {};
const ADAPTIVE = { style: { size: "adaptive" } };
const DISCS = { style: { size: "adaptive", shape: "disc" } };
const DEGREE = Math.PI / 180;

const style = (parts) => ({ off: {}, on: { style: parts } });
const box = { kind: "box", mode: "inside", center: { source: POSE.at }, size: [250, 250, 400] };

/**
 * What each effect is compared with and in which look. `fills` change how well points cover the picture and are held
 * against one reference; the others show something else, and each is held against a reference that shows that too.
 */
const EFFECTS = [
  { effect: "nothing (the same twice)", fills: true, off: {}, on: {} },
  { effect: "points at all", off: { empty: true }, on: {} },
  { effect: "prefix level of detail", fills: true, off: { wholeNodes: true }, on: {} },
  { effect: "attenuated size", fills: true, off: {}, on: { style: { size: "attenuated" } } },
  { effect: "adaptive size", fills: true, off: {}, on: ADAPTIVE, picture: "adaptive" },
  { effect: "disc", fills: true, off: ADAPTIVE, on: DISCS },
  {
    effect: "paraboloid",
    fills: true,
    off: ADAPTIVE,
    on: { style: { size: "adaptive", shape: "paraboloid" } },
  },
  {
    ...{ effect: "blended splats", fills: true, off: DISCS, picture: "splats" },
    on: { style: { ...DISCS.style, splats: true } },
  },
  { effect: "Eye-Dome Lighting, 4", ...style({ eyeDomeLighting: eyeDome(4) }), picture: "eye-dome" },
  { effect: "Eye-Dome Lighting, 8", ...style({ eyeDomeLighting: eyeDome(8) }) },
  { effect: "gradient (elevation)", ...style({ color: "elevation" }) },
  { effect: "classification colours", ...style({ color: "classification" }) },
  { effect: "opacity 0.5", ...style({ opacity: 0.5 }) },
  { effect: "clip box", off: {}, on: { clips: [{ ...box, heading: 20 * DEGREE, pitch: 0, roll: 0 }] } },
  { effect: "filter (intensity)", off: {}, on: { filter: { ranges: { intensity: [0, 60] } } } },
];

function eyeDome(neighbours) {
  return { strength: 0.4, radius: 1.4, neighbours };
}

/** Default point budget and screen-space error. */
const BUDGET = 1_000_000;
const SPACING = 2;
const BUDGETS = [50_000, 100_000, 200_000, 500_000, BUDGET, 2_000_000, Number.POSITIVE_INFINITY];
const SPACINGS = [32, 16, 8, 4, SPACING, 1];

/** Spacing on the screen that no node falls short of. */
const NO_LIMIT = 1e-6;

/** Each effect on and off. */
export async function measureEffects(page, frames) {
  const rows = [];
  for (const { effect, fills = false, off, on, picture } of EFFECTS) {
    const truths = { off: {}, on: fills ? {} : on };
    const found = await compare(page, { off, on }, truths, frames);
    rows.push({ part: "effects", effect, fills, ...row(found) });
    console.log(`  ${effect}`);
    if (picture) rows.at(-1).picture = { name: picture, data: await strip(page, truths.on) };
  }
  return rows;
}

/** Budgets without any other limit, and screen-space errors without any budget, all against the default. */
export async function measureBudgets(page, frames) {
  const rows = [];
  for (const [look, base] of [
    ["fixed size, 2 px", FIXED],
    ["adaptive size", ADAPTIVE],
  ]) {
    const isDefault = base === FIXED;
    for (const pointBudget of BUDGETS) {
      const maximumScreenSpaceError = NO_LIMIT;
      const looks = {
        off: { maximumScreenSpaceError, pointBudget: BUDGET },
        on: { ...base, maximumScreenSpaceError, pointBudget },
      };
      const found = await compare(page, looks, { off: {}, on: {} }, frames);
      const limit = { budget: pointBudget === Number.POSITIVE_INFINITY ? "none" : pointBudget };
      rows.push({
        part: "budget",
        look,
        ...limit,
        chosen: isDefault && pointBudget === BUDGET,
        ...row(found),
      });
      console.log(`  ${look}, budget ${pointBudget}`);
    }
    for (const pixels of SPACINGS) {
      const pointBudget = Number.POSITIVE_INFINITY;
      const looks = {
        off: { maximumScreenSpaceError: SPACING, pointBudget },
        on: { ...base, maximumScreenSpaceError: pixels, pointBudget },
      };
      const found = await compare(page, looks, { off: {}, on: {} }, frames);
      rows.push({ part: "spacing", look, pixels, chosen: isDefault && pixels === SPACING, ...row(found) });
      console.log(`  ${look}, screen-space error ${pixels}`);
    }
  }
  return rows;
}

/** Widths in spacings, and the default. */
const FACTORS = [1, 1.25, 1.5, 1.75, 2, 2.5];
const FACTOR = 2;

/** What widths leave open and draw twice, at the default screen-space error. */
export async function measureWidths(page) {
  const looks = [
    { look: "fixed size, 2 px", factor: undefined, style: {} },
    ...["attenuated", "adaptive"].flatMap((size) =>
      FACTORS.map((factor) => ({ look: `${size} size`, factor, style: { size, spacingFactor: factor } })),
    ),
  ];
  const rows = [];
  for (const { look, factor, style } of looks) {
    const { holes, overdraw, rms, changed } = await page.evaluate((look) => window.bench.coverage(look), {
      style,
    });
    const chosen = factor === FACTOR;
    rows.push({ part: "widths", look, factor, chosen, holes, overdraw, onRms: rms, onWrongPixels: changed });
  }
  console.log("  widths");
  return rows;
}

/** Points that references are drawn with. */
export function pointsInSight(page) {
  return page.evaluate(() => window.bench.everyPoint({}));
}

function compare(page, looks, truths, pairs) {
  return page.evaluate(([...args]) => window.bench.compare(...args), [looks, truths, pairs]);
}

/** The looks compared last and a reference, small enough to lie beside a report. */
function strip(page, truth) {
  return page.evaluate(([...args]) => window.bench.strip(...args), [truth, 320, 240, 58_000]);
}

/** Times as medians; the ratio is that of frames that followed each other. */
function row({ times, shown, change, error }) {
  const ratios = times.on.map((time, i) => time / times.off[i]).sort((a, b) => a - b);
  return {
    offMs: median(times.off),
    onMs: median(times.on),
    ratio: median(ratios),
    ratioQuartiles: [ratios[Math.floor(ratios.length / 4)], ratios[Math.floor((3 * ratios.length) / 4)]],
    offPoints: shown.off.points,
    onPoints: shown.on.points,
    nodes: shown.on.nodes,
    active: shown.on.effects,
    changeRms: change.rms,
    changedPixels: change.changed,
    offRms: error.off.rms,
    onRms: error.on.rms,
    offWrongPixels: error.off.changed,
    onWrongPixels: error.on.changed,
    frames: times.on.length,
  };
}

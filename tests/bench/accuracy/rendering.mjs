import { median } from "./rendering-figures.mjs";

/** From where the scan is looked at: the stadium and what lies around it, the distance in metres. */
export const POSE = { at: [637_290, 851_210, 430], heading: 30, pitch: -40, range: 400 };

/** Frames of each look that are timed, in turn with those of the other. */
const FRAMES = 9;

/** A tolerance that whole steps leave, metres: positions stay float32. */
export const FINE = 1e-5;

/** The size that closes what lies between points of any level. */
export const ADAPTIVE = { style: { size: "adaptive" } };
const DISCS = { style: { size: "adaptive", shape: "disc" } };
const SPLATS = { ...DISCS.style, splats: true };
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
  { effect: "logarithmic depth", fills: true, off: { logDepth: false }, on: {} },
  { effect: "positions as float32", fills: true, off: {}, on: { tolerance: FINE } },
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
    on: { style: SPLATS },
  },
  { effect: "Eye-Dome Lighting, 4", ...style({ eyeDomeLighting: eyeDome(4) }), picture: "eye-dome" },
  { effect: "Eye-Dome Lighting, 8", ...style({ eyeDomeLighting: eyeDome(8) }) },
  {
    effect: "Eye-Dome Lighting, 4, on splats",
    off: { style: SPLATS },
    on: { style: { ...SPLATS, eyeDomeLighting: eyeDome(4) } },
  },
  { effect: "gradient (elevation)", ...style({ color: "elevation" }) },
  { effect: "classification colours", ...style({ color: "classification" }) },
  { effect: "opacity 0.5", ...style({ opacity: 0.5 }) },
  { effect: "clip box", off: {}, on: { clips: [{ ...box, heading: 20 * DEGREE, pitch: 0, roll: 0 }] } },
  { effect: "filter (intensity)", off: {}, on: { filter: { ranges: { intensity: [0, 60] } } } },
];

function eyeDome(neighbours) {
  return { strength: 0.4, radius: 1.4, neighbours };
}

/** Each effect on and off. */
export async function measureEffects(page) {
  const rows = [];
  for (const { effect, fills = false, off, on, picture } of EFFECTS) {
    const truths = { off: {}, on: fills ? {} : on };
    const found = await compare(page, { off, on }, truths, FRAMES);
    rows.push({ part: "effects", effect, fills, ...row(found) });
    console.log(`  ${effect}`);
    if (picture) rows.at(-1).picture = { name: picture, data: await strip(page, truths.on) };
  }
  return rows;
}

/** Points that references are drawn with. */
export function pointsInSight(page) {
  return page.evaluate(() => window.bench.everyPoint({}));
}

/** Draws two looks in turn, so many frames of each. */
export function compare(page, looks, truths, pairs) {
  return page.evaluate(([...args]) => window.bench.compare(...args), [looks, truths, pairs]);
}

/** The looks compared last and a reference, small enough to lie beside a report. */
function strip(page, truth) {
  return page.evaluate(([...args]) => window.bench.strip(...args), [truth, 320, 240, 58_000]);
}

/** Times are medians, the ratio is that of all frames together, the quartiles are those of frames that followed each other. */
export function row({ times, shown, change, error }) {
  const ratios = times.on.map((time, i) => time / times.off[i]).sort((a, b) => a - b);
  return {
    offMs: median(times.off),
    onMs: median(times.on),
    ratio: sum(times.on) / sum(times.off),
    ratioQuartiles: [ratios[Math.floor(ratios.length / 4)], ratios[Math.floor((3 * ratios.length) / 4)]],
    offPoints: shown.off.points,
    onPoints: shown.on.points,
    offBytes: shown.off.bytes,
    onBytes: shown.on.bytes,
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

const sum = (values) => values.reduce((all, value) => all + value, 0);

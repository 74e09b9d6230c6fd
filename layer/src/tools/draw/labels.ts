import type { ScreenPoint } from "./view-adapter.js";

/** A label that wants to stand near a place. */
export interface LabelWish {
  readonly anchor: ScreenPoint;
  readonly width: number;
  readonly height: number;
  /** Where it stood before: it stays there as long as it hides nothing. */
  readonly slot?: number | undefined;
}

/** Where a label stands. */
export interface LabelPlace extends ScreenPoint {
  readonly slot: number;
}

/** Part of a view, CSS pixels. */
export interface ScreenBox {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** What labels keep clear of. */
export interface Obstacles {
  /** Places that no label should hide. */
  readonly points: readonly ScreenPoint[];
  /** Lines, place by place; with gaps where they leave the view. */
  readonly lines: readonly (readonly (ScreenPoint | undefined)[])[];
  /** What lies over the view: panels of the application. */
  readonly covered: readonly ScreenBox[];
}

/** Pixels between a label and what it belongs to, and around it. */
const GAP = 14;
/** Pixels around a place that are kept free. */
const AROUND = 6;
/** Square pixels that a pixel of a hidden line counts for. */
const LINE = 8;

/** Where a label may stand around its anchor, as shares of its size and of the gap, the best first. */
const SIDES = [
  [0, -1],
  [1, -1],
  [1, 0],
  [1, 1],
  [0, 1],
  [-1, 1],
  [-1, 0],
  [-1, -1],
] as const;
const ROUNDS = 4;
const SLOTS = Array.from({ length: ROUNDS * SIDES.length }, (_, slot) => slot);

/**
 * Upper left corners of labels that overlap neither each other nor what is measured nor what lies over the view, each as
 * near to its anchor as that allows; what finds no free place within four rounds stands where it covers least.
 *
 * @param size of the view: labels stay in it where they can
 */
export function placeLabels(
  wishes: readonly LabelWish[],
  obstacles: Obstacles,
  size: { readonly width: number; readonly height: number },
): LabelPlace[] {
  const taken: ScreenBox[] = [];
  return wishes.map((wish) => {
    let best = boxAt(wish, 0);
    let found = 0;
    let least = Number.POSITIVE_INFINITY;
    for (const slot of wish.slot === undefined ? SLOTS : [wish.slot, ...SLOTS]) {
      const box = boxAt(wish, slot);
      const cost = costOf(box, taken, obstacles, size);
      if (cost < least) [best, found, least] = [box, slot, cost];
      if (cost === 0) break;
    }
    taken.push(best);
    return { x: best.left, y: best.top, slot: found };
  });
}

/**
 * The place of a figure that its label should stand at: the one wished for where it is seen, else the nearest of the figure
 * that is.
 */
export function seenAnchor(
  wished: ScreenPoint,
  way: readonly (ScreenPoint | undefined)[],
  covered: readonly ScreenBox[],
  { width, height }: { readonly width: number; readonly height: number },
): ScreenPoint {
  const seen = ({ x, y }: ScreenPoint) =>
    x >= 0 && y >= 0 && x <= width && y <= height && !covered.some((box) => isIn(box, x, y, 0));
  if (seen(wished)) return wished;
  let nearest = wished;
  let least = Number.POSITIVE_INFINITY;
  way.forEach((to, i) => {
    const from = way[i - 1] ?? to;
    for (let step = 0; to && from && step <= 16; step++) {
      const at = { x: from.x + ((to.x - from.x) * step) / 16, y: from.y + ((to.y - from.y) * step) / 16 };
      const away = Math.hypot(at.x - wished.x, at.y - wished.y);
      if (away < least && seen(at)) [nearest, least] = [at, away];
    }
  });
  return nearest;
}

function boxAt({ anchor, width, height }: LabelWish, slot: number): ScreenBox {
  const [across, down] = SIDES[slot % SIDES.length];
  const gap = GAP * (1 + Math.floor(slot / SIDES.length));
  const left = anchor.x - width / 2 + across * (width / 2 + gap);
  const top = anchor.y - height / 2 + down * (height / 2 + gap);
  return { left, top, right: left + width, bottom: top + height };
}

/**
 * Square pixels of other labels and of what lies over the view that a box takes; as much as its own for each place that it
 * hides or side that it leaves; and what it hides of lines.
 */
function costOf(
  box: ScreenBox,
  taken: readonly ScreenBox[],
  { points, lines, covered }: Obstacles,
  { width, height }: { width: number; height: number },
): number {
  const whole = (box.right - box.left) * (box.bottom - box.top);
  let cost = 0;
  for (const other of taken) cost += common(box, other);
  // Under a panel nothing can be read.
  for (const other of covered) cost += 4 * common(box, other);
  for (const { x, y } of points) if (isIn(box, x, y, AROUND)) cost += whole;
  for (const line of lines) {
    for (let i = 1; i < line.length; i++) {
      const [from, to] = [line[i - 1], line[i]];
      if (from && to) cost += LINE * lengthIn(box, from, to);
    }
  }
  const outside = box.left < 0 || box.top < 0 || box.right > width || box.bottom > height;
  return outside ? cost + whole : cost;
}

function isIn(box: ScreenBox, x: number, y: number, around: number): boolean {
  return x > box.left - around && x < box.right + around && y > box.top - around && y < box.bottom + around;
}

/** Square pixels that two boxes have in common. */
function common(a: ScreenBox, b: ScreenBox): number {
  const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
  const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
  return across > 0 && down > 0 ? across * down : 0;
}

/** Pixels of a line that lie in a box (Liang and Barsky 1984). */
function lengthIn(box: ScreenBox, from: ScreenPoint, to: ScreenPoint): number {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  let [first, last] = [0, 1];
  for (const [rate, room] of [
    [-dx, from.x - box.left],
    [dx, box.right - from.x],
    [-dy, from.y - box.top],
    [dy, box.bottom - from.y],
  ] as const) {
    if (rate === 0) {
      if (room < 0) return 0;
    } else if (rate < 0) first = Math.max(first, room / rate);
    else last = Math.min(last, room / rate);
  }
  return last > first ? (last - first) * Math.hypot(dx, dy) : 0;
}

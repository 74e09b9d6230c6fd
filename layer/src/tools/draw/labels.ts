import type { ScreenPoint } from "./view-adapter.js";

/** A label that wants to stand near a place. */
export interface LabelWish {
  readonly anchor: ScreenPoint;
  readonly width: number;
  readonly height: number;
}

interface Box {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** Pixels between a label and what it belongs to, and around it. */
const GAP = 14;

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

/**
 * Upper left corners of labels that overlap neither each other nor the places that are measured, each as near to its
 * anchor as that allows; what finds no free place within four rounds stands where it covers least.
 *
 * @param kept places that no label should hide
 * @param size of the view: labels stay in it where they can
 */
export function placeLabels(
  wishes: readonly LabelWish[],
  kept: readonly ScreenPoint[],
  size: { readonly width: number; readonly height: number },
): ScreenPoint[] {
  const taken: Box[] = [];
  return wishes.map((wish) => {
    let best: Box | undefined;
    let least = Number.POSITIVE_INFINITY;
    for (let round = 1; round <= 4 && least > 0; round++) {
      for (const [across, down] of SIDES) {
        const box = boxAt(wish, across, down, round * GAP);
        const cost = costOf(box, taken, kept, size);
        if (cost < least) [best, least] = [box, cost];
        if (cost === 0) break;
      }
    }
    const box = best ?? boxAt(wish, 0, -1, GAP);
    taken.push(box);
    return { x: box.left, y: box.top };
  });
}

function boxAt({ anchor, width, height }: LabelWish, across: number, down: number, gap: number): Box {
  const left = anchor.x - width / 2 + across * (width / 2 + gap);
  const top = anchor.y - height / 2 + down * (height / 2 + gap);
  return { left, top, right: left + width, bottom: top + height };
}

/** Square pixels of other labels that a box covers, and as much for each place that it hides or side that it leaves. */
function costOf(
  box: Box,
  taken: readonly Box[],
  kept: readonly ScreenPoint[],
  { width, height }: { width: number; height: number },
): number {
  const whole = (box.right - box.left) * (box.bottom - box.top);
  let cost = 0;
  for (const other of taken) {
    const across = Math.min(box.right, other.right) - Math.max(box.left, other.left);
    const down = Math.min(box.bottom, other.bottom) - Math.max(box.top, other.top);
    if (across > 0 && down > 0) cost += across * down;
  }
  for (const { x, y } of kept) {
    if (x > box.left - 6 && x < box.right + 6 && y > box.top - 6 && y < box.bottom + 6) cost += whole;
  }
  const outside = box.left < 0 || box.top < 0 || box.right > width || box.bottom > height;
  return outside ? cost + whole : cost;
}

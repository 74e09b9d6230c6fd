import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { type LabelWish, placeLabels, type ScreenBox, seenAnchor } from "./labels.js";
import type { ScreenPoint } from "./view-adapter.js";

const size = { width: 800, height: 600 };
const NONE = { points: [], lines: [], covered: [] };
const place = fc.record({ x: fc.integer({ min: 150, max: 650 }), y: fc.integer({ min: 100, max: 500 }) });
const labelAt = (anchor: ScreenPoint): LabelWish => ({ anchor, width: 80, height: 24 });
const boxOf = ({ x, y }: ScreenPoint): ScreenBox => ({ left: x, top: y, right: x + 80, bottom: y + 24 });
const overlap = (a: ScreenBox, b: ScreenBox) =>
  a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

/** Whether a line passes through a box, by its places every tenth of a pixel. */
function passes({ left, top, right, bottom }: ScreenBox, from: ScreenPoint, to: ScreenPoint): boolean {
  const steps = Math.ceil(10 * Math.hypot(to.x - from.x, to.y - from.y));
  return Array.from({ length: steps + 1 }, (_, i) => i / Math.max(1, steps)).some((share) => {
    const [x, y] = [from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)];
    return x > left && x < right && y > top && y < bottom;
  });
}

describe("labels", () => {
  it("overlap neither each other nor what is measured, and stay in the view", () => {
    fc.assert(
      fc.property(fc.array(place, { maxLength: 6 }), (anchors) => {
        const boxes = placeLabels(anchors.map(labelAt), { ...NONE, points: anchors }, size);
        for (const [i, one] of boxes.entries()) {
          expect(one.x >= 0 && one.y >= 0 && one.x <= 720 && one.y <= 576).toBe(true);
          for (const { x, y } of anchors) {
            expect(x > one.x && x < one.x + 80 && y > one.y && y < one.y + 24).toBe(false);
          }
          for (const other of boxes.slice(0, i)) expect(overlap(boxOf(one), boxOf(other))).toBe(false);
        }
      }),
    );
  });

  it("stand above what they belong to where nothing is in the way", () => {
    expect(placeLabels([labelAt({ x: 400, y: 300 })], NONE, size)).toEqual([{ x: 360, y: 262, slot: 0 }]);
  });

  it("hide no line of two places, their own neither", () => {
    fc.assert(
      fc.property(place, place, (from, to) => {
        const middle = { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
        const obstacles = { ...NONE, points: [from, to], lines: [[from, to]] };
        const [label] = placeLabels([labelAt(middle)], obstacles, size);
        expect(passes(boxOf(label), from, to)).toBe(false);
      }),
    );
  });

  it("stand beside what lies over the view, with what of the figure is seen", () => {
    const panel = { left: 0, top: 0, right: 340, bottom: 600 };
    fc.assert(
      fc.property(
        fc.integer({ min: 20, max: 300 }),
        fc.integer({ min: 450, max: 780 }),
        place,
        (a, b, { y }) => {
          const way = [
            { x: a, y },
            { x: b, y: 300 },
          ];
          const wished = { x: (a + b) / 2, y: (y + 300) / 2 };
          const anchor = seenAnchor(wished, way, [panel], size);
          expect(anchor.x).toBeGreaterThanOrEqual(340);
          if (wished.x >= 340) expect(anchor).toBe(wished);
          const [label] = placeLabels([labelAt(anchor)], { ...NONE, covered: [panel] }, size);
          expect(overlap(boxOf(label), panel)).toBe(false);
        },
      ),
    );
    // Of what is wholly covered there is nothing to stand at.
    const under = { x: 100, y: 100 };
    expect(seenAnchor(under, [under, { x: 200, y: 100 }], [panel], size)).toBe(under);
  });

  it("stay where they stood as long as that hides nothing", () => {
    const anchor = { x: 400, y: 300 };
    const [below] = placeLabels([{ ...labelAt(anchor), slot: 4 }], NONE, size);
    expect(below).toMatchObject({ y: 314, slot: 4 });
    const points = [{ x: 400, y: 320 }];
    expect(placeLabels([{ ...labelAt(anchor), slot: 4 }], { ...NONE, points }, size)[0].slot).toBe(0);
  });
});

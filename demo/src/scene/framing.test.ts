import { describe, expect, it } from "vitest";
import { fitView, viewWindow } from "./framing.js";

const canvas = { width: 800, height: 400 };
const fieldOfView = Math.PI / 2;

/** Pixel of a point seen from a stand, on the canvas above. */
function pixel(point: readonly number[], stand: { right: number; up: number; back: number }): number[] {
  const depth = point[2]! + stand.back;
  const scale = canvas.height / 2 / Math.tan(fieldOfView / 2) / depth;
  return [400 + (point[0]! - stand.right) * scale, 200 - (point[1]! - stand.up) * scale];
}

const box: number[][] = [];
for (const x of [-30, 70]) for (const y of [-8, 4]) for (const z of [-20, 45]) box.push([x, y, z]);

describe("framing", () => {
  it.each([
    { name: "the whole canvas", area: { left: 0, top: 0, right: 800, bottom: 400 } },
    { name: "the part beside a panel", area: { left: 320, top: 10, right: 790, bottom: 390 } },
    { name: "a low strip", area: { left: 0, top: 300, right: 800, bottom: 400 } },
  ])("fills $name and not more", ({ area }) => {
    const stand = fitView(box.flat(), viewWindow(area, canvas, fieldOfView), 1);
    const pixels = box.map((point) => pixel(point, stand));
    const xs = pixels.map(([x]) => x!);
    const ys = pixels.map(([, y]) => y!);
    const gaps = {
      left: Math.min(...xs) - area.left,
      right: area.right - Math.max(...xs),
      top: Math.min(...ys) - area.top,
      bottom: area.bottom - Math.max(...ys),
    };
    for (const gap of Object.values(gaps)) expect(gap).toBeGreaterThan(-1e-9);
    const tightest = Math.min(gaps.left + gaps.right, gaps.top + gaps.bottom);
    expect(tightest).toBeLessThan(1e-9);
    // In the middle, in both directions.
    expect(gaps.left).toBeCloseTo(gaps.right, 6);
    expect(gaps.top).toBeCloseTo(gaps.bottom, 6);
  });

  it("keeps its distance from a single point", () => {
    const window = viewWindow({ left: 0, top: 0, right: 800, bottom: 400 }, canvas, fieldOfView);
    const stand = fitView([5, 6, 7], window, 10);
    expect(stand.back + 7).toBe(10);
    expect(stand.right).toBeCloseTo(5);
    expect(stand.up).toBeCloseTo(6);
  });
});

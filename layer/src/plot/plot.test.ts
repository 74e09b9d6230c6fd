import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { OFFSET } from "../effects/index.js";
import { richFacts, styleOf } from "../effects/scene.fixture.js";
import { PlotView } from "../tools/plot/plot-view.js";
import { plotCamera } from "./plot-camera.js";
import { profileLedger } from "./plot-ledger.js";
import { planSeries, plotStyle } from "./plot-plan.js";
import { LEVEL } from "./section-vertices.js";

/** Clip coordinates of a place of the plot, in the node frame of an origin. */
function clip(camera: ReturnType<typeof plotCamera>, origin: number[], local: number[]): number[] {
  const times = (matrix: readonly number[], vector: readonly number[]) =>
    [0, 1, 2, 3].map((row) => vector.reduce((sum, value, at) => sum + matrix[4 * at + row]! * value, 0));
  return times(camera.projection, times(camera.modelView(origin, 0), [...local, 1]));
}

describe("the camera of a plot", () => {
  it("puts places where the view has them, and what is nearer to the line before the rest", () => {
    const shown = fc.record({
      from: fc.double({ min: -1e5, max: 1e5, noNaN: true }),
      along: fc.double({ min: 0.1, max: 1e5, noNaN: true }),
      low: fc.double({ min: -1e4, max: 1e4, noNaN: true }),
      up: fc.double({ min: 0.1, max: 1e3, noNaN: true }),
      place: fc.tuple(fc.double({ min: 0, max: 1, noNaN: true }), fc.double({ min: 0, max: 1, noNaN: true })),
      reach: fc.double({ min: 0, max: 500, noNaN: true }),
    });
    fc.assert(
      fc.property(shown, ({ from, along, low, up, place, reach }) => {
        const view = new PlotView(700, 300);
        view.fit({ from, to: from + along, low, high: low + up });
        const camera = plotCamera(view, reach, 2);
        const [chainage, height] = [from + place[0] * along, low + place[1] * up];
        const origin = [Math.floor(chainage), Math.floor(height), 0];
        const at = (offset: number) =>
          clip(camera, origin, [chainage - origin[0]!, height - origin[1]!, -Math.abs(offset)]);
        const [x, y, near, w] = at(0);
        const [px, py] = view.pixelOf(chainage, height);
        expect(w).toBe(1);
        expect(((x! + 1) / 2) * 700).toBeCloseTo(px, 4);
        expect(((1 - y!) / 2) * 300).toBeCloseTo(py, 4);
        expect(near).toBeGreaterThan(-1);
        expect(at(reach)[2]).toBeLessThan(1);
        if (reach > 1e-6) expect(at(reach)[2]).toBeGreaterThan(near!);
      }),
    );
  });
});

describe("the effects of a plot", () => {
  const { attributes } = richFacts();
  const cloud = { attributes, bounds: { spacing: 8 } };
  const view = new PlotView(800, 200);
  view.fit({ from: 0, to: 100, low: 0, high: 10 });
  const plan = (parts: Parameters<typeof styleOf>[0]) => {
    const style = plotStyle(styleOf(parts));
    const series = { cloud, style, filter: undefined, nodes: 9, points: 1e5, deepest: 4, reach: 1.5 };
    return planSeries(series, view, 1, true);
  };

  it("are the style's, but for those that ask for depth or for an octree around points", () => {
    const all = {
      color: "intensity",
      shape: "disc",
      size: "adaptive",
      eyeDomeLighting: true,
      gamma: 2,
    } as const;
    const running = (parts: Parameters<typeof styleOf>[0]) => [...plan(parts).active].sort();
    expect(running({ ...all, pointSize: 9 })).toEqual(["disc", "fixedSize", "gradient", "tone"]);
    expect(running({ color: "classification", size: "attenuated", opacity: 0.5 })).toEqual(
      expect.arrayContaining(["classification", "fixedSize", "opacity"]),
    );
  });

  it("colour by distance from the line over its whole range, and by the level of a point's node", () => {
    const range = (color: string) => {
      const { scene, active } = plan({ color });
      expect(active).toContain("gradient");
      return scene.facts.attributes.find(({ name }) => name === color)?.range;
    };
    expect(range(OFFSET)).toEqual([-1.5, 1.5]);
    expect(range(LEVEL)).toEqual([0, 4]);
  });
});

it("the ledger of a profile tells of curvature and refraction from the length on at which they reach the tolerance", () => {
  // d = √(2 R · 1 mm / 0.87)
  const [short] = profileLedger({ length: 121 }, 0.001);
  const [long] = profileLedger({ length: 122 }, 0.001);
  expect([short!.active, long!.active]).toEqual([false, true]);
  expect(long!.magnitude).toBeCloseTo(0.0010163, 7);
  expect(profileLedger({ length: 5000 }, 0.001, { refraction: 0 })[0]!.magnitude).toBeCloseTo(1.962, 3);
});

import { expect, it } from "vitest";
import { OctreeNode } from "../octree/index.js";
import { nodesHere } from "../octree/nodes-here.fixture.js";
import { cloudPlacing, placingFacts } from "./placing-facts.js";
import { planEffects } from "./plan.js";
import { richFacts, styleOf } from "./scene.fixture.js";

it("tells what is known of the placing, from the data set's own map", () => {
  // 0.04 % too long, 47 m above the ellipsoid, on the equator, heights in feet.
  const placed = {
    place(x: number, y: number, z: number, out: Float64Array) {
      out.set([6_378_137 + 47 + z * 0.3048, (x - 500_000) / 0.9996, y / 0.9996]);
      return out;
    },
    boundingBox: { min: [499_900, -100, 0] as const, max: [500_100, 100, 300] as const },
    crs: { horizontalUnit: { kind: "linear" as const, size: 1 }, verticalUnit: { size: 0.3048 } },
    height: { kind: "geoid" as const },
    accuracy: { parts: [{ name: "datum operation", metres: null }] },
  };
  const nodes = [0, 1].map((x) => new OctreeNode({ depth: 1, x, y: 0, z: 0 }, "listed"));
  const lying = {
    toCube: new Float64Array(12),
    frame: { origin: [0, 0, 0], rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1] },
  };
  const narrow = {
    ...lying,
    ...{ scheme: "affine", bound: 4e-4, box: [-50, -50, 0, 50, 50, 20], step: 2 ** -12 },
  };
  const wide = { ...lying, scheme: "cubic", bound: 2e-6, box: [-1000, -1000, 0, 1000, 900, 20] };
  const factsOf = (...points: Parameters<typeof nodesHere>[1]) => {
    const { slots, shapes } = nodesHere(nodes, points);
    return placingFacts(cloudPlacing(placed), slots, shapes);
  };
  const placing = factsOf(narrow, wide);
  const { ledger } = planEffects(
    styleOf(),
    richFacts({ placing, placingPixels: 0.2, depthStepPixels: 3, logarithmicDepth: true }),
  );
  const row = (name: string) => ledger.find(({ effect }) => effect === name)!;
  expect(row("geoid").magnitude).toBeCloseTo(47, 3);
  expect(row("gridScale").magnitude).toBeCloseTo(1 / 0.9996 - 1, 6);
  expect(row("curvature").magnitude).toBeCloseTo(2000 ** 2 / 8 / 6_371_009, 6);
  expect(row("curvature")).toMatchObject({ active: true, threshold: 0.001, unit: "m" });
  expect(row("placing").magnitude).toBe(4e-4);
  // Half the steps of the narrow node are more than what float32 costs in the wide one.
  expect(row("storage").magnitude).toBeCloseTo(Math.sqrt(3) * (2 ** -13 + 50 * 2 ** -24), 9);
  expect(row("storage").why).toContain("1 at whole steps (8 bytes a point), 1 as float32 (12 bytes)");
  expect(placing.schemes).toEqual({ affine: 1, cubic: 1 });
  expect(factsOf(undefined, wide)).toMatchObject({ schemes: { cubic: 1 }, stored: { steps: 0, floats: 1 } });
  expect(factsOf(undefined, wide).storageBound).toBeCloseTo(Math.sqrt(3) * 1000 * 2 ** -24, 9);
  expect(row("datum operation").magnitude).toBeNaN();
  expect(row("placingOnScreen")).toMatchObject({ magnitude: 0.2, threshold: 0.05, unit: "px", active: true });
  const far = planEffects(styleOf(), richFacts({ placing, placingPixels: 0.01 })).ledger;
  expect(far.find(({ effect }) => effect === "placingOnScreen")).toMatchObject({ active: false });
  expect(row("logarithmicDepth")).toMatchObject({ magnitude: 3, threshold: 0.25, active: true });
});

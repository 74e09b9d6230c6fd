import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { outsideFrustum } from "../octree/index.js";
import { mapCamera } from "./map-camera.js";

const BOUNDS = { x: 1000, y: 2000, z: 50, radius: 100, spacing: 1 };
const FRAME = {
  view: { center: [1000, 2000], resolution: 0.5, rotation: 0 },
  ...{ size: [600, 400], pixelRatio: 2, metresPerUnit: 1, worldWidth: undefined, bounds: BOUNDS },
};

/** CSS pixel of a place, as the GPU finds it. */
function pixelOf(frame: Parameters<typeof mapCamera>[0], place: readonly number[], world = 0): number[] {
  const camera = mapCamera(frame);
  const [a, b, , , c, d, , , , , , , x, y, z] = camera.modelView(place, world);
  expect([a, d]).toEqual([d, a]);
  expect(b).toBe(-c);
  const depth = camera.projection[10] * z + camera.projection[14];
  expect(Math.abs(depth)).toBeLessThanOrEqual(1);
  const [width, height] = frame.size;
  return [(width / 2) * (1 + x * camera.projection[0]), (height / 2) * (1 - y * camera.projection[5])];
}

describe("the camera of a map", () => {
  it("shows places where OpenLayers shows them, at any turn, scale and unit", () => {
    const numbers = fc.record({
      rotation: fc.double({ min: -4, max: 4, noNaN: true }),
      resolution: fc.double({ min: 1e-3, max: 1e4, noNaN: true }),
      metresPerUnit: fc.constantFrom(1, 0.3048, 111319.49),
      east: fc.integer({ min: -200, max: 200 }),
      north: fc.integer({ min: -200, max: 200 }),
    });
    fc.assert(
      fc.property(numbers, ({ rotation, resolution, metresPerUnit, east, north }) => {
        const center = [1000 / metresPerUnit, 2000 / metresPerUnit];
        const frame = { ...FRAME, metresPerUnit, view: { center, resolution, rotation } };
        const unit = resolution * metresPerUnit;
        const [x, y] = pixelOf(frame, [1000 + east * unit, 2000 + north * unit, 50]);
        const [cosine, sine] = [Math.cos(rotation), Math.sin(rotation)];
        // ol/transform.compose of coordinateToPixelTransform.
        expect(x).toBeCloseTo(300 + cosine * east + sine * north, 4);
        expect(y).toBeCloseTo(200 + sine * east - cosine * north, 4);
      }),
    );
  });

  it("culls what lies beside the picture, and nothing in it", () => {
    const turned = { ...FRAME, view: { ...FRAME.view, rotation: Math.PI / 2 } };
    const { view } = mapCamera(turned).frame;
    const at = (x: number, y: number) => outsideFrustum(view, { ...BOUNDS, x, y, radius: 1 });
    // Turned by a right angle the picture is 200 m across and 300 m along.
    expect([at(1098, 2000), at(1102, 2000), at(898, 2000)]).toEqual([false, true, true]);
    expect([at(1000, 2148), at(1000, 2152), at(1000, 1848)]).toEqual([false, true, true]);
  });

  it("shows the world in which the data set lies, and several where they are in the picture", () => {
    const width = 10_000;
    const far = { ...FRAME, worldWidth: width, view: { ...FRAME.view, center: [1000 - 2 * width, 2000] } };
    expect(mapCamera(far).worlds).toEqual([-2 * width]);
    expect(pixelOf(far, [1000, 2000, 50], -2 * width)).toEqual([300, 200]);
    const whole = { ...FRAME, worldWidth: width, view: { ...FRAME.view, resolution: 40 } };
    expect([...mapCamera(whole).worlds].sort((a, b) => a - b)).toEqual([-width, 0, width]);
    // Beyond 180° the other way round.
    const beside = {
      ...FRAME,
      worldWidth: width,
      view: { ...FRAME.view, center: [1000 + width - 50, 2000] },
    };
    expect(mapCamera(beside).worlds).toEqual([width]);
  });
});

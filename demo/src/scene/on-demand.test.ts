import type { PointCloudLayer } from "@groma/layer/cesium";
import { expect, it } from "vitest";
import { drawChanges } from "./on-demand.js";

/** Goes through frames of a page, and counts those of its scene that are asked for. */
function page(layers: PointCloudLayer[], frames: () => number) {
  let asked = 0;
  let passed = () => {};
  const scene = {
    preUpdate: { addEventListener: (listener: () => void) => (passed = listener) },
    requestRender: () => void asked++,
  };
  drawChanges(scene as never, () => layers, frames);
  return (count: number) => {
    const before = asked;
    for (let frame = 0; frame < count; frame++) passed();
    return asked - before;
  };
}

const options = {
  ...{ show: true, style: {}, filter: undefined, forced: {}, clips: { revision: 0 }, budget: undefined },
  ...{ pointBudget: 1, maximumScreenSpaceError: 2, heightOffset: 0, settled: true },
};

it("asks for a frame after each change of a layer, and for none while all is as it was", () => {
  const layer = { ...options } as unknown as PointCloudLayer;
  const layers: PointCloudLayer[] = [];
  const passed = page(layers, () => 1);
  passed(1);
  const change = (how: () => void) => {
    expect(passed(5)).toBe(0);
    how();
    expect(passed(5)).toBe(1);
  };
  change(() => layers.push(layer));
  for (const [name, value] of Object.entries({
    ...{ show: false, style: {}, filter: {}, forced: {}, clips: { revision: 0 }, budget: {} },
    ...{ pointBudget: 2, maximumScreenSpaceError: 3, heightOffset: 1 },
  })) {
    change(() => Object.assign(layer, { [name]: value }));
  }
  change(() => Object.assign(layer.clips, { revision: 1 }));
  change(() => layers.pop());
});

it("draws as many frames after a change as are asked for", () => {
  const layer = { ...options } as unknown as PointCloudLayer;
  let frames = 1;
  const passed = page([layer], () => frames);
  passed(1);
  frames = 30;
  expect(passed(100)).toBe(30);
  layer.heightOffset = 2;
  expect(passed(10)).toBe(10);
  layer.heightOffset = 3;
  expect(passed(100)).toBe(30);
});

it("draws until each layer shows what its view wants", () => {
  const layer = { ...options, settled: true };
  const passed = page([{ ...layer }, layer] as unknown as PointCloudLayer[], () => 1);
  passed(1);
  expect(passed(5)).toBe(0);
  layer.settled = false;
  expect(passed(5)).toBe(5);
  layer.settled = true;
  expect(passed(5)).toBe(0);
});

import { Cartesian3, type Scene } from "cesium";
import { expect, it } from "vitest";
import { steadyCamera } from "./steady-camera.js";

it("puts a camera back that was turned by rounding, and none that was moved", () => {
  let [begins, drawn] = [() => {}, () => {}];
  const camera = {
    ...{ direction: new Cartesian3(0.6, 0.8, 0), up: new Cartesian3(0, 0, 1) },
    right: new Cartesian3(0.8, -0.6, 0),
  };
  const scene = {
    camera,
    preUpdate: { addEventListener: (listener: () => void) => (begins = listener) },
    postRender: { addEventListener: (listener: () => void) => (drawn = listener) },
  };
  steadyCamera(scene as unknown as Scene);
  drawn();
  camera.direction.x += 2e-16;
  camera.up.y += 1e-15;
  begins();
  expect([camera.direction.x, camera.up.y]).toEqual([0.6, 0]);
  camera.direction.x += 1e-9;
  begins();
  expect(camera.direction.x).toBe(0.6 + 1e-9);
});

import { Color } from "cesium";
import { onPoints } from "../../../browser/stage/point-calls.js";
import type { Stage } from "../../../browser/stage/stage.js";
import type { Picture } from "./picture.js";

/** How well points cover what could be seen. */
export interface Coverage {
  /** Share of the pixels inside the outline that show the background. */
  readonly holes: number;
  /** Fragments of points per pixel inside the outline. */
  readonly overdraw: number;
}

/** Makes every point white, whatever its colour. */
export const WHITE = { color: "rgb", brightness: 1 } as const;

/** Whether each pixel of a picture of white points shows nothing but points. */
export function outlineOf({ rgb }: Picture): readonly boolean[] {
  return Array.from({ length: rgb.length / 3 }, (_, pixel) => rgb[3 * pixel]! >= 254);
}

/** Share of the pixels of an outline in which a picture of white points shows the background. */
export function holesIn({ rgb }: Picture, outline: readonly boolean[]): number {
  return meanOf(outline, (pixel) => (rgb[3 * pixel]! < 128 ? 1 : 0));
}

/** Fragments per pixel of an outline, of a picture that {@link countingFragments} drew. */
export function fragmentsIn({ rgb }: Picture, outline: readonly boolean[]): number {
  return meanOf(outline, (pixel) => rgb[3 * pixel]!);
}

/** What `draw` draws of white points where each fragment adds a step of 255 to black, with no depth test. */
export function countingFragments({ gl, scene }: Stage, draw: () => Picture): Picture {
  const { backgroundColor } = scene;
  const step = 1 / 255;
  scene.backgroundColor = Color.BLACK;
  const end = onPoints(gl, (call) => {
    gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendColor(step, step, step, step);
    gl.blendFunc(gl.CONSTANT_COLOR, gl.ONE);
    call.draw();
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
  });
  try {
    return draw();
  } finally {
    end();
    scene.backgroundColor = backgroundColor;
  }
}

function meanOf(outline: readonly boolean[], value: (pixel: number) => number): number {
  let inside = 0;
  let sum = 0;
  outline.forEach((isInside, pixel) => {
    if (!isInside) return;
    inside++;
    sum += value(pixel);
  });
  return sum / inside;
}

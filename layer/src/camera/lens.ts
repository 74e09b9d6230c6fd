import { cross, difference, dot, unit, type Vector } from "@groma/georef";
import type { CameraPose } from "./pose.js";
import type { Ray } from "./surface.js";

/** Half of the picture's edges: tangents of half of the fields of view, or metres where there is no perspective. */
export interface PictureHalves {
  readonly right: number;
  readonly up: number;
  /** Whether all rays have the camera's direction. Default: they begin in one place. */
  readonly parallel?: boolean;
}

/** A place of a picture, CSS pixels from the upper left. */
export interface ScreenPlace {
  readonly x: number;
  readonly y: number;
}

/** What a camera makes its picture with. */
export interface Lens {
  /** CSS pixels. */
  readonly width: number;
  readonly height: number;
  readonly halves: PictureHalves;
}

/** The ray through a place of the picture; without perspective it begins beside the camera. */
export function rayThrough(
  { position, direction, up }: CameraPose,
  { width, height, halves }: Lens,
  { x, y }: ScreenPlace,
): Ray {
  const [a, b] = [((2 * x) / width - 1) * halves.right, (1 - (2 * y) / height) * halves.up];
  const right = cross(direction, up);
  const beside = (from: Vector): Vector => {
    const along = (axis: number) => from[axis] + a * right[axis] + b * up[axis];
    return [along(0), along(1), along(2)];
  };
  if (halves.parallel) return { origin: beside(position), direction };
  return { origin: position, direction: unit(beside(direction)) };
}

/** Where a place of ECEF is in the picture; undefined where it is not in front of the camera. */
export function placeInPicture(
  { position, direction, up }: CameraPose,
  { width, height, halves }: Lens,
  place: Vector,
): ScreenPlace | undefined {
  const away = difference(place, position);
  const depth = dot(away, direction);
  if (depth <= 0) return undefined;
  const scale = halves.parallel ? 1 : depth;
  const across = dot(away, cross(direction, up)) / scale / halves.right;
  const along = dot(away, up) / scale / halves.up;
  return { x: ((1 + across) * width) / 2, y: ((1 - along) * height) / 2 };
}

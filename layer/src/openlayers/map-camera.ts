import type { FrameCamera } from "../drawing/frame-camera.js";
import type { NodeBounds } from "../octree/index.js";
import type { FlatCamera } from "../webgl2/flat-camera.js";

/** What a frame of a map shows. */
export interface MapViewState {
  /** Units of the projection. */
  readonly center: readonly number[];
  /** Units of the projection per CSS pixel. */
  readonly resolution: number;
  /** Radians, clockwise: how far the map is turned. */
  readonly rotation: number;
}

/** What a camera over a map is made from. */
export interface MapFrame {
  readonly view: MapViewState;
  /** CSS pixels. */
  readonly size: readonly number[];
  readonly pixelRatio: number;
  /** Nominal metres per unit of the projection. */
  readonly metresPerUnit: number;
  /** Width of the world in units of the projection, where it repeats. */
  readonly worldWidth: number | undefined;
  /** Sphere around all points, in the plane of the map. */
  readonly bounds: NodeBounds;
}

/** A camera that looks straight down on a map, without perspective. */
export interface MapCamera extends FlatCamera {
  readonly frame: FrameCamera;
  /** Distances of the near and far planes, metres. */
  readonly near: number;
  readonly far: number;
}

/** Metres between the camera and the highest point, and below the lowest. */
const MARGIN = 10;

/** The camera of a frame. */
export function mapCamera({
  view,
  size,
  pixelRatio,
  metresPerUnit,
  worldWidth,
  bounds,
}: MapFrame): MapCamera {
  const { center, resolution, rotation } = view;
  const [x, y] = [center[0] * metresPerUnit, center[1] * metresPerUnit];
  const [width, height] = size.map((edge) => Math.max(1, Math.round(edge * pixelRatio)));
  // Half of the picture, nominal metres. The canvas may be wider than the map by part of a pixel, and is shown as wide.
  const [halfX, halfY] = size.map((edge) => (edge / 2) * resolution * metresPerUnit);
  const [cosine, sine] = [Math.cos(rotation), Math.sin(rotation)];
  const reach = bounds.radius + MARGIN;
  const top = bounds.z + reach;
  const [near, far] = [MARGIN / 2, 2 * reach];
  const eyeHeight = top + near;
  const worlds = worldsIn(x, Math.hypot(halfX, halfY), bounds, worldWidth && worldWidth * metresPerUnit);
  const [world = 0] = worlds;
  const position = [x - world, y, eyeHeight];
  const frame: FrameCamera = {
    view: {
      position,
      direction: [0, 0, -1],
      // Where several worlds show, all of the data set does.
      planes: worlds.length > 1 ? [] : sidesOf(position, halfX, halfY, cosine, sine),
      height,
      projection: { kind: "orthographic", extent: 2 * halfY },
      horizon: false,
    },
    width,
    pixelRatio,
    near,
    depth: { own: false, scene: false },
    pose: () => [...center, resolution, rotation, ...size, pixelRatio],
  };
  return {
    ...{ frame, width, height, pixelRatio, worlds, near, far },
    projection: [
      ...[1 / halfX, 0, 0, 0],
      ...[0, 1 / halfY, 0, 0],
      ...[0, 0, -2 / (far - near), 0],
      ...[0, 0, -(far + near) / (far - near), 1],
    ],
    modelView(origin, shift) {
      const east = origin[0] + shift - x;
      const north = origin[1] - y;
      return [
        ...[cosine, -sine, 0, 0],
        ...[sine, cosine, 0, 0],
        ...[0, 0, 1, 0],
        ...[cosine * east + sine * north, cosine * north - sine * east, origin[2] - eyeHeight, 1],
      ];
    },
  };
}

/** Shifts of the worlds in which the data set may show, the one in the middle of the picture first. */
function worldsIn(x: number, reach: number, bounds: NodeBounds, width: number | undefined): number[] {
  if (!width) return [0];
  const shift = (turn: number) => turn * width;
  const nearest = Math.round((x - bounds.x) / width);
  const across = Math.ceil((reach + bounds.radius) / width);
  const turns = Array.from({ length: 2 * across + 1 }, (_, index) => nearest + index - across);
  const shown = turns.filter((turn) => Math.abs(bounds.x + shift(turn) - x) <= reach + bounds.radius);
  shown.sort((a, b) => Math.abs(a - nearest) - Math.abs(b - nearest));
  return (shown.length > 0 ? shown : [nearest]).map(shift);
}

/** The four sides of the picture as planes, inner sides positive. */
function sidesOf(
  [x, y]: readonly number[],
  halfX: number,
  halfY: number,
  cosine: number,
  sine: number,
): number[] {
  // Directions of the picture's right and upper side on the map.
  const sides = [
    [cosine, sine, halfX],
    [-cosine, -sine, halfX],
    [-sine, cosine, halfY],
    [sine, -cosine, halfY],
  ];
  return sides.flatMap(([east, north, half]) => [-east, -north, 0, east * x + north * y + half]);
}

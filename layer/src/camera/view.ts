/** Where a camera stands and how it looks, to be kept. Angles are radians. */
export interface CameraView {
  /** Of WGS 84. */
  readonly longitude: number;
  readonly latitude: number;
  /** Above the ellipsoid, metres. */
  readonly height: number;
  /** Clockwise from north. */
  readonly heading: number;
  /** Above the horizon. */
  readonly pitch: number;
  readonly roll: number;
}

/** Names of its numbers, in the order in which they are written. */
export const CAMERA_VIEW = ["longitude", "latitude", "height", "heading", "pitch", "roll"] as const;

/** Least and greatest height that a camera can go to, metres: above the middle of the earth, and as far as views draw. */
export const HEIGHTS = [-6_000_000, 1e12] as const;

/** Whether the numbers are those of a camera that a view can take: what comes from links and files need not be. */
export function isCameraView(
  numbers: { readonly [name in keyof CameraView]: unknown },
): numbers is CameraView {
  if (!CAMERA_VIEW.every((name) => Number.isFinite(numbers[name]))) return false;
  const { latitude, height } = numbers as CameraView;
  return Math.abs(latitude) <= Math.PI / 2 && height >= HEIGHTS[0] && height <= HEIGHTS[1];
}

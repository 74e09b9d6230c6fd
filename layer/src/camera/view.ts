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

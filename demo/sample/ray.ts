/**
 * One laser pulse: position on the way is `(x + t·dx, y + t·dy, z + t·dz)`, t in metres from the aircraft,
 * direction of length 1 and downwards (dz < 0).
 */
export interface Ray {
  x: number;
  y: number;
  z: number;
  dx: number;
  dy: number;
  dz: number;
}

/** What a pulse met on its way; ASPRS classes of LAS 1.4, table 17. */
export interface Echo {
  /** Distance from the aircraft, metres. */
  range: number;
  classification: number;
  /** Share of the light that reaches it that comes back, 0 to 1. */
  reflectance: number;
  /** Colour in sunlight, linear 0 to 1. */
  red: number;
  green: number;
  blue: number;
  /** How squarely the sun falls on it: cosine of the incidence, or a guess for foliage. */
  sunlit: number;
  /** True when nothing passes: the last echo of its pulse. */
  solid: boolean;
}

/** ASPRS standard classes used here (LAS 1.4 R15, table 17). */
export const CLASS = {
  ground: 2,
  lowVegetation: 3,
  mediumVegetation: 4,
  highVegetation: 5,
  building: 6,
  water: 9,
  road: 11,
  wire: 14,
  tower: 15,
  bridge: 17,
} as const;

/** Direction towards the sun: azimuth 135°, elevation 43°, a clear morning that lights the rock face. */
export const SUN = sunDirection((135 * Math.PI) / 180, (43 * Math.PI) / 180);

function sunDirection(azimuth: number, elevation: number): { x: number; y: number; z: number } {
  const level = Math.cos(elevation);
  return { x: level * Math.sin(azimuth), y: level * Math.cos(azimuth), z: Math.sin(elevation) };
}

/** How squarely the sun falls on a surface with this unit normal: 0 when it faces away. */
export function sunOn(nx: number, ny: number, nz: number): number {
  return Math.max(0, nx * SUN.x + ny * SUN.y + nz * SUN.z);
}

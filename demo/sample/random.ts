import { createNoise2D } from "simplex-noise";

/** A source of uniform numbers in [0, 1). */
export type Random = () => number;

/** Smooth noise over the plane, in about [-1, 1]. */
export type Noise = (x: number, y: number) => number;

/**
 * Seeded generator sfc32 (Chris Doty-Humphrey, PractRand): the same seed gives the same scan on every machine.
 * Integer arithmetic only, so no engine rounds it differently.
 */
export function createRandom(seed: number): Random {
  let a = seed | 0;
  let b = 0x9e3779b9;
  let c = 0x243f6a88;
  let counter = 1;
  const next = (): number => {
    const sum = (a + b + counter) | 0;
    counter = (counter + 1) | 0;
    a = b ^ (b >>> 9);
    b = (c + (c << 3)) | 0;
    c = ((c << 21) | (c >>> 11)) + sum;
    return (sum >>> 0) / 4294967296;
  };
  for (let i = 0; i < 12; i++) next();
  return next;
}

/** Uniform number in [low, high). */
export function between(random: Random, low: number, high: number): number {
  return low + (high - low) * random();
}

/** Sum of `octaves` layers of simplex noise, each half as high and twice as fine; wavelength in metres. */
export function createFractalNoise(random: Random, wavelength: number, octaves: number): Noise {
  const layer = createNoise2D(random);
  return (x, y) => {
    let frequency = 1 / wavelength;
    let amplitude = 1;
    let sum = 0;
    let total = 0;
    for (let i = 0; i < octaves; i++) {
      sum += amplitude * layer(x * frequency + 17 * i, y * frequency - 31 * i);
      total += amplitude;
      frequency *= 2;
      amplitude *= 0.5;
    }
    return sum / total;
  };
}

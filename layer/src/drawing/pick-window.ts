/** Pixels. */
export interface Size {
  readonly width: number;
  readonly height: number;
}

/**
 * The number in the pixel nearest to the middle of a square window; 0 where all are empty.
 * @param pixels RGBA bytes, a number per pixel with its least significant byte first
 * @param window edge of the square, pixels; odd
 */
export function nearestId(pixels: Uint8Array, window: number): number {
  const numbers = new DataView(pixels.buffer, pixels.byteOffset, pixels.byteLength);
  const middle = (window - 1) / 2;
  let best = 0;
  let least = Number.POSITIVE_INFINITY;
  for (let row = 0; row < window; row++) {
    for (let column = 0; column < window; column++) {
      const id = numbers.getUint32(4 * (row * window + column), true);
      const distance = (row - middle) ** 2 + (column - middle) ** 2;
      if (id === 0 || distance >= least) continue;
      best = id;
      least = distance;
    }
  }
  return best;
}

/**
 * Edge of a window in pixels of the drawing buffer: odd, so that it has a middle, and never smaller than was asked for, also
 * where the buffer has fewer pixels than the screen.
 */
export function windowPixels(cssPixels: number, pixelRatio: number): number {
  return 2 * Math.ceil(Math.max(0, cssPixels * pixelRatio - 1) / 2) + 1;
}

/** Pixel of the drawing buffer, from the lower left, of a place on the canvas in CSS pixels from the upper left. */
export function bufferPixel(
  { x, y }: { readonly x: number; readonly y: number },
  canvas: { readonly clientWidth: number; readonly clientHeight: number },
  { width, height }: Size,
): { readonly x: number; readonly y: number } {
  return {
    x: Math.floor((x * width) / canvas.clientWidth),
    y: height - 1 - Math.floor((y * height) / canvas.clientHeight),
  };
}

/** A part of a profile: chainages and heights, in the units of the axes. */
export interface PlotExtent {
  readonly from: number;
  readonly to: number;
  readonly low: number;
  readonly high: number;
}

/** Which axes a zoom changes. */
export type PlotAxes = "both" | "along" | "up";

/** Least length of an axis, in its unit: a tenth of a millimetre of metres. */
const LEAST = 1e-4;
/** Greatest length of an axis, as a multiple of the extent that was fitted. */
const MOST = 20;

/**
 * What a plot of chainage against height shows: pans, zooms and stretches heights. It changes what is seen, never the data.
 * Pixels count from the upper left corner of the plot.
 */
export class PlotView {
  #width: number;
  #height: number;
  #shown: PlotExtent = { from: 0, to: 1, low: 0, high: 1 };
  #fitted: PlotExtent = this.#shown;

  /** @param width of the plot, pixels */
  constructor(width: number, height: number) {
    this.#width = Math.max(1, width);
    this.#height = Math.max(1, height);
  }

  /** What is seen. */
  get shown(): PlotExtent {
    return this.#shown;
  }

  get width(): number {
    return this.#width;
  }

  get height(): number {
    return this.#height;
  }

  /** Pixels per unit of height, by pixels per unit of chainage. */
  get exaggeration(): number {
    const { from, to, low, high } = this.#shown;
    return this.#height / (high - low) / (this.#width / (to - from));
  }

  /** Stretches heights about the middle of what is seen; 1 shows true angles. @throws RangeError where it is none */
  set exaggeration(exaggeration: number) {
    if (!(exaggeration > 0 && Number.isFinite(exaggeration)))
      throw new RangeError(`the exaggeration cannot be ${exaggeration}`);
    const { from, to, low, high } = this.#shown;
    const half = (this.#height * (to - from)) / this.#width / exaggeration / 2;
    const middle = (low + high) / 2;
    this.#shown = { from, to, low: middle - half, high: middle + half };
  }

  /** Whether all of the fitted extent is seen, and nothing else was asked for since. */
  get isFitted(): boolean {
    return this.#shown === this.#fitted;
  }

  /** Shows an extent whole, as large as it may be, with a little room around it. */
  fit({ from, to, low, high }: PlotExtent): void {
    const [along, up] = [Math.max(to - from, LEAST), Math.max(high - low, LEAST)];
    this.#fitted = { from, to: from + along, low: low - 0.05 * up, high: low + 1.05 * up };
    this.#shown = this.#fitted;
  }

  /** Keeps the scale of chainages and the exaggeration, and the upper left corner, while the plot is resized. */
  resize(width: number, height: number): void {
    if (width === this.#width && height === this.#height) return;
    const fitted = this.isFitted;
    const { from, to, low, high } = this.#shown;
    const [along, up] = [(to - from) / this.#width, (high - low) / this.#height];
    this.#width = Math.max(1, width);
    this.#height = Math.max(1, height);
    if (!fitted) this.#shown = { from, to: from + along * this.#width, low: high - up * this.#height, high };
  }

  /** Moves what is seen with a pointer that moves by so many pixels, right and down. */
  panBy(right: number, down: number): void {
    const { from, to, low, high } = this.#shown;
    const along = (-right * (to - from)) / this.#width;
    const up = (down * (high - low)) / this.#height;
    this.#shown = { from: from + along, to: to + along, low: low + up, high: high + up };
  }

  /** Makes things larger by a factor about a pixel, which stays where it is. */
  zoomAt(x: number, y: number, factor: number, axes: PlotAxes = "both"): void {
    if (!(factor > 0 && Number.isFinite(factor))) return;
    const { from, to, low, high } = this.#shown;
    const { from: first, to: last, low: least, high: greatest } = this.#fitted;
    const [chainage, height] = this.placeOf(x, y);
    const scale = (length: number, whole: number) =>
      Math.min(Math.max(length / factor, LEAST), Math.max(length, MOST * whole)) / length;
    const along = axes === "up" ? 1 : scale(to - from, last - first);
    const up = axes === "along" ? 1 : scale(high - low, greatest - least);
    // Both axes keep their proportion, also where one has reached its limit.
    const both = Math.abs(along - 1) < Math.abs(up - 1) ? along : up;
    const [a, b] = axes === "both" ? [both, both] : [along, up];
    this.#shown = {
      ...{ from: chainage + (from - chainage) * a, to: chainage + (to - chainage) * a },
      ...{ low: height + (low - height) * b, high: height + (high - height) * b },
    };
  }

  /** Pixel of a place. */
  pixelOf(chainage: number, height: number): readonly [x: number, y: number] {
    const { from, to, low, high } = this.#shown;
    return [((chainage - from) / (to - from)) * this.#width, ((high - height) / (high - low)) * this.#height];
  }

  /** Chainage and height at a pixel. */
  placeOf(x: number, y: number): readonly [chainage: number, height: number] {
    const { from, to, low, high } = this.#shown;
    return [from + (x / this.#width) * (to - from), high - (y / this.#height) * (high - low)];
  }
}

import { FormatError } from "../../errors/index.js";
import type { Pixels } from "./sheet.js";

/** Rows that are made room for at a time. */
const STRIPE = 64;

/** Pixels that are made room for at most, ten bytes each: A0 at 200 dots per inch, half of it empty. */
const MOST_PIXELS = 1 << 25;

interface Stripe {
  /** Red, green, blue of each pixel, as they are recorded. */
  readonly colours: Uint16Array;
  /** Distance of the point that a pixel shows from the line; infinite where it shows none. */
  readonly distance: Float32Array;
}

/**
 * Points as dots on paper: each point colours the pixel that it falls on, and of several the one nearest to the line is
 * seen. Only the columns have to be known before; rows are added as points come.
 */
export class Dots {
  readonly columns: number;
  readonly #file: string;
  readonly #stripes = new Map<number, Stripe>();
  #low = Number.POSITIVE_INFINITY;
  #high = Number.NEGATIVE_INFINITY;
  #brightest = 0;
  /** Least and greatest number of a stripe. */
  #first = Number.POSITIVE_INFINITY;
  #last = Number.NEGATIVE_INFINITY;

  /** @param file named in errors */
  constructor(columns: number, file: string) {
    this.columns = Math.max(1, Math.ceil(columns));
    this.#file = file;
  }

  /** Least and greatest row with a dot; infinite, and the wrong way round, where there is none. */
  get rows(): readonly [low: number, high: number] {
    return [this.#low, this.#high];
  }

  /**
   * @param column from the left; those beyond are put onto the border
   * @param row upwards, from any origin
   * @param distance of the point from the line
   * @throws FormatError EXPORT_PICTURE where the picture becomes too large
   */
  add(column: number, row: number, distance: number, red: number, green: number, blue: number): void {
    const number = Math.floor(row / STRIPE);
    let stripe = this.#stripes.get(number);
    stripe ??= this.#grow(number);
    const x = Math.min(this.columns - 1, Math.max(0, Math.floor(column)));
    const y = Math.floor(row);
    const at = (y - number * STRIPE) * this.columns + x;
    if (y < this.#low) this.#low = y;
    if (y > this.#high) this.#high = y;
    if (distance >= stripe.distance[at]) return;
    stripe.distance[at] = distance;
    stripe.colours[3 * at] = red;
    stripe.colours[3 * at + 1] = green;
    stripe.colours[3 * at + 2] = blue;
    this.#brightest = Math.max(this.#brightest, red, green, blue);
  }

  #grow(number: number): Stripe {
    const pixels = STRIPE * this.columns;
    this.#first = Math.min(this.#first, number);
    this.#last = Math.max(this.#last, number);
    // What lies between dots takes room in the picture too.
    if ((this.#last - this.#first + 1) * pixels > MOST_PIXELS) throw tooLarge(this.#file);
    const stripe = {
      colours: new Uint16Array(3 * pixels),
      distance: new Float32Array(pixels).fill(Number.POSITIVE_INFINITY),
    };
    this.#stripes.set(number, stripe);
    return stripe;
  }

  /** The rows from `low` up to `high`, transparent where no point is. */
  pixels(low: number, high: number): Pixels {
    const rows = high - low + 1;
    const data = new Uint8Array(4 * rows * this.columns);
    // Colours of 8 bits that are recorded in 16 stand for 8 bits.
    const shift = this.#brightest > 255 ? 8 : 0;
    for (let row = low; row <= high; row++) {
      const number = Math.floor(row / STRIPE);
      const stripe = this.#stripes.get(number);
      if (!stripe) continue;
      const from = (row - number * STRIPE) * this.columns;
      let to = 4 * (high - row) * this.columns;
      for (let x = 0; x < this.columns; x++, to += 4) {
        if (stripe.distance[from + x] === Number.POSITIVE_INFINITY) continue;
        const colour = 3 * (from + x);
        data[to] = stripe.colours[colour] >> shift;
        data[to + 1] = stripe.colours[colour + 1] >> shift;
        data[to + 2] = stripe.colours[colour + 2] >> shift;
        data[to + 3] = 255;
      }
    }
    return { columns: this.columns, rows, data };
  }
}

function tooLarge(file: string): FormatError {
  return new FormatError({
    code: "EXPORT_PICTURE",
    file,
    cause: "the picture would be too large for its scale",
    fix: "Choose a smaller scale, such as 1:1000, or less exaggeration",
  });
}

import { Dots } from "./dots.js";
import { fittingScale, layOut, type PictureWords, roundScale } from "./layout.js";
import type { Sheet } from "./sheet.js";

/** How a picture is drawn to scale. */
export interface PictureScale {
  /** Lengths are drawn 1 : this. Default: the largest round scale at which the line fits onto A3. */
  readonly scale?: number | undefined;
  /**
   * How much heights are stretched against lengths; with `most`, as much as their scale is round too, and no more than that.
   * Default: 1.
   */
  readonly exaggeration?: number | { readonly most: number } | undefined;
}

/** What is drawn, and the sizes of its units. */
export interface PictureOptions extends PictureScale {
  /** Chainage of both ends. */
  readonly from: number;
  readonly to: number;
  /** Metres in a unit of chainage, and in one of height. */
  readonly unit: number;
  readonly heightUnit: number;
  /** Name of the data set, for errors. */
  readonly file: string;
}

/** Size of a dot, millimetres: 200 to the inch; of very long drawings 100. */
const PITCH = 25.4 / 200;
const MOST_COLUMNS = 20_000;

/** The picture of a profile or a section, as it is printed: takes points, then becomes a sheet. */
export class ProfilePicture {
  readonly #options: PictureOptions;
  readonly #scale: number;
  readonly #exaggeration: number;
  readonly #pitch: number;
  /** Millimetres per unit. */
  readonly #along: number;
  readonly #up: number;
  readonly #dots: Dots;

  /** @throws RangeError where the scale or the exaggeration is none */
  constructor(options: PictureOptions) {
    const { from, to, unit, heightUnit, exaggeration: wanted = 1, file } = options;
    const length = (to - from) * unit;
    const scale = options.scale ?? fittingScale(length);
    if (!(scale > 0 && Number.isFinite(scale))) throw new RangeError(`the scale cannot be 1:${scale}`);
    const most = typeof wanted === "number" ? wanted : wanted.most;
    if (!(most > 0 && Number.isFinite(most))) throw new RangeError(`the exaggeration cannot be ${most}`);
    const exaggeration = typeof wanted === "number" ? wanted : scale / roundScale(scale / most);
    this.#options = options;
    this.#scale = scale;
    this.#exaggeration = exaggeration;
    this.#along = (1000 * unit) / scale;
    this.#up = (1000 * heightUnit * exaggeration) / scale;
    const columns = ((to - from) * this.#along) / PITCH;
    this.#pitch = columns > MOST_COLUMNS ? 2 * PITCH : PITCH;
    this.#dots = new Dots(((to - from) * this.#along) / this.#pitch, file);
  }

  /** @param offset from the line, of which the nearest point of a dot is seen */
  add(chainage: number, height: number, offset: number, red: number, green: number, blue: number): void {
    const column = ((chainage - this.#options.from) * this.#along) / this.#pitch;
    this.#dots.add(column, (height * this.#up) / this.#pitch, Math.abs(offset), red, green, blue);
  }

  /** @param runs chainages and heights of a terrain line, a list for each stretch */
  sheet(words: PictureWords, runs: Parameters<typeof layOut>[2] = []): Sheet {
    const { from, to } = this.#options;
    const [low, high] = this.#dots.rows;
    const empty = !(high >= low);
    const pixels = empty ? this.#dots.pixels(0, 0) : this.#dots.pixels(low, high);
    const bottom = ((empty ? 0 : low) * this.#pitch) / this.#up;
    const frame = { from, to, along: this.#along, up: this.#up };
    const scale = { along: this.#scale, up: this.#scale / this.#exaggeration };
    return layOut(frame, { pixels, bottom, pitch: this.#pitch }, runs, words, scale);
  }
}

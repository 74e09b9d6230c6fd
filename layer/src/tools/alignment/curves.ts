import { type Alignment, TOLERANCE } from "./alignment.js";

type Place = readonly [x: number, y: number];
type Headings = Alignment["headings"][number];

/** A line that grows by straight stretches, arcs and clothoids. */
export class CurveLine {
  readonly vertices: Place[];
  /** True length of each stretch. */
  readonly lengths: number[] = [];
  /** True directions at both ends of each stretch; undefined where it is straight. */
  readonly headings: Headings[] = [];

  constructor(start: Place) {
    this.vertices = [start];
  }

  get end(): Place {
    return this.vertices[this.vertices.length - 1];
  }

  lineTo(place: Place): void {
    const [x, y] = this.end;
    this.#add(place, Math.hypot(place[0] - x, place[1] - y));
  }

  /**
   * An arc about a centre.
   * @param turn angle that it turns by, radians, to the left positive
   */
  arcTo(place: Place, centre: Place, turn: number): void {
    const [x, y] = this.end;
    const radius = Math.hypot(x - centre[0], y - centre[1]);
    const begin = Math.atan2(y - centre[1], x - centre[0]);
    const count = steps(Math.abs(turn) * radius, 1 / radius);
    const ahead = begin + (Math.sign(turn) * Math.PI) / 2;
    for (let step = 1; step <= count; step++) {
      const angle = begin + (turn * step) / count;
      const on: Place = [centre[0] + radius * Math.cos(angle), centre[1] + radius * Math.sin(angle)];
      const headings = [ahead + (turn * (step - 1)) / count, ahead + (turn * step) / count] as const;
      this.#add(step === count ? place : on, (Math.abs(turn) * radius) / count, headings);
    }
  }

  /**
   * A clothoid, whose curvature changes evenly along it.
   *
   * @param place where the file says that it ends
   * @param heading at its start, radians from the x axis, counter-clockwise
   * @param first curvature at its start, 1 / radius, to the left positive
   * @param last at its end
   * @returns how far its end lies from the place given; the difference is spread over its length
   */
  clothoidTo(place: Place, heading: number, length: number, first: number, last: number): number {
    const from = this.end;
    const count = steps(length, Math.max(Math.abs(first), Math.abs(last)));
    const places: Place[] = [];
    let [x, y] = from;
    for (let step = 0; step < count; step++) {
      const [a, b] = [(length * step) / count, (length * (step + 1)) / count];
      const [dx, dy] = clothoidStep(a, b, heading, length, first, last);
      x += dx;
      y += dy;
      places.push([x, y]);
    }
    const [missX, missY] = [place[0] - x, place[1] - y];
    for (const [step, [px, py]] of places.entries()) {
      const share = (step + 1) / count;
      const on: Place = [px + share * missX, py + share * missY];
      const [from, to] = [step / count, share].map(
        (part) => heading + turnOf(part * length, length, first, last),
      );
      this.#add(step + 1 === count ? place : on, length / count, [from, to]);
    }
    return Math.hypot(missX, missY);
  }

  #add(place: Place, length: number, headings?: Headings): void {
    this.vertices.push(place);
    this.lengths.push(length);
    this.headings.push(headings);
  }
}

/** Chords of a curve: each lies within the tolerance of it (sagitta c² · curvature / 8). */
function steps(length: number, curvature: number): number {
  const chord = Math.sqrt((8 * TOLERANCE) / Math.max(curvature, 1e-12));
  return Math.max(1, Math.ceil(length / chord));
}

/** Places and weights of Gauss's rule of five places on [-1, 1]. */
const GAUSS = [
  [0, 128 / 225],
  [Math.sqrt(5 - 2 * Math.sqrt(10 / 7)) / 3, (322 + 13 * Math.sqrt(70)) / 900],
  [Math.sqrt(5 + 2 * Math.sqrt(10 / 7)) / 3, (322 - 13 * Math.sqrt(70)) / 900],
] as const;

/** What a clothoid has turned by at a length along it, radians, to the left positive. */
function turnOf(along: number, length: number, first: number, last: number): number {
  return first * along + ((last - first) * along * along) / (2 * length);
}

/** What a clothoid moves by between two lengths along it. */
function clothoidStep(
  a: number,
  b: number,
  heading: number,
  length: number,
  first: number,
  last: number,
): Place {
  let [x, y] = [0, 0];
  const [middle, half] = [(a + b) / 2, (b - a) / 2];
  for (const [place, weight] of GAUSS) {
    for (const side of place === 0 ? [0] : [-place, place]) {
      const s = middle + half * side;
      const angle = heading + turnOf(s, length, first, last);
      x += weight * half * Math.cos(angle);
      y += weight * half * Math.sin(angle);
    }
  }
  return [x, y];
}

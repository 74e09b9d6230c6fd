/** Chainages of cross-sections along a line. */
export interface StationOptions {
  /** Distance between stations, in the unit of the line's chainage; round multiples of it, and both ends of the line. */
  readonly interval?: number | undefined;
  /** Chainages of further stations; an end of the line may be given as it reads rounded to two decimals or more. */
  readonly at?: readonly number[] | undefined;
}

/** Stations at most: a slip of the keyboard must not ask for millions. */
const MOST = 100_000;

/**
 * Chainages between the ends of a line, rising, each once: its ends and the multiples of an interval, and those given.
 *
 * @param from chainage at the start of the line
 * @param to chainage at its end
 * @throws RangeError where the interval is not above 0, a chainage lies beyond the line, or none is asked for
 */
export function stations(from: number, to: number, { interval, at = [] }: StationOptions): number[] {
  const found = at.map((chainage) =>
    isRounded(chainage, to) ? to : isRounded(chainage, from) ? from : chainage,
  );
  const beyond = found.find((chainage) => !(chainage >= from && chainage <= to));
  if (beyond !== undefined)
    throw new RangeError(`the line has no chainage ${beyond}: it is ${from} to ${to}`);
  if (interval !== undefined) {
    if (!(interval > 0 && Number.isFinite(interval)))
      throw new RangeError(`the interval cannot be ${interval}`);
    if ((to - from) / interval > MOST) throw new RangeError(`${interval} is too small an interval`);
    found.push(from, to);
    const last = Math.floor(to / interval);
    for (let step = Math.ceil(from / interval); step <= last; step++) {
      const chainage = step * interval;
      if (chainage > from && chainage < to) found.push(chainage);
    }
  }
  if (found.length === 0) throw new RangeError("neither an interval nor a station is given");
  return [...new Set(found)].sort((a, b) => a - b);
}

/** Decimals that chainages are printed with: at least, and the most that change anything. */
const PRINTED = [2, 12] as const;

/** Whether a chainage is an end of the line as it reads where it is printed with fewer digits than it has. */
function isRounded(chainage: number, end: number): boolean {
  if (chainage === end || Math.abs(chainage - end) > 0.5 * 10 ** -PRINTED[0] * (1 + 1e-9)) return false;
  for (let digits = PRINTED[0]; digits <= PRINTED[1]; digits++)
    if (Number(end.toFixed(digits)) === chainage) return true;
  return false;
}

/**
 * A chainage as surveyors write it: `1+250.00`, thousands before the sign.
 * @param digits behind the point
 */
export function stationText(chainage: number, digits = 2): string {
  const steps = Math.round(Math.abs(chainage) * 10 ** digits);
  const sign = chainage < 0 && steps > 0 ? "-" : "";
  const [whole, part] = [Math.floor(steps / 10 ** digits), steps % 10 ** digits];
  const rest = String(whole % 1000).padStart(3, "0");
  const decimals = digits > 0 ? `.${String(part).padStart(digits, "0")}` : "";
  return `${sign}${Math.floor(whole / 1000)}+${rest}${decimals}`;
}

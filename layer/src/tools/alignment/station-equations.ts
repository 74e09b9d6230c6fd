/** A place on a line from which on stations are counted anew (LandXML 1.2, StaEquation). */
export interface StationEquation {
  /** Chainage without any equation. */
  readonly internal: number;
  /** Station from there on. */
  readonly ahead: number;
  /** Whether stations grow or fall from there on. Default: they grow. */
  readonly increment?: "increasing" | "decreasing" | undefined;
}

/** A station as it is written on plans, and in which stretch between equations: where stations overlap, that tells them apart. */
export interface Station {
  readonly station: number;
  /** 0 before the first equation. */
  readonly stretch: number;
}

/** Stations of a line whose chainage is counted anew in places. */
export class StationEquations {
  readonly equations: readonly StationEquation[];

  /** @throws RangeError where a number is not finite, or two equations hold at one chainage */
  constructor(equations: readonly StationEquation[]) {
    const sorted = [...equations].sort((a, b) => a.internal - b.internal);
    for (const [at, { internal, ahead }] of sorted.entries()) {
      if (!Number.isFinite(internal + ahead)) throw new RangeError("a station equation is not finite");
      if (at > 0 && sorted[at - 1].internal === internal)
        throw new RangeError(`there are two station equations at ${internal}`);
    }
    this.equations = sorted;
  }

  /** The station of a chainage; an equation holds from its own place on. */
  stationOf(chainage: number): Station {
    const stretch = this.equations.findLastIndex(({ internal }) => internal <= chainage) + 1;
    if (stretch === 0) return { station: chainage, stretch };
    const { internal, ahead, increment } = this.equations[stretch - 1];
    const along = chainage - internal;
    return { station: increment === "decreasing" ? ahead - along : ahead + along, stretch };
  }

  /** The chainages that have a station, rising: none in a gap of the stations, several where they overlap. */
  chainagesOf(station: number): number[] {
    const found: number[] = [];
    const edges = [Number.NEGATIVE_INFINITY, ...this.equations.map(({ internal }) => internal)];
    for (const [stretch, from] of edges.entries()) {
      const to = edges[stretch + 1] ?? Number.POSITIVE_INFINITY;
      const equation = this.equations[stretch - 1];
      const along = equation ? station - equation.ahead : station;
      const chainage = equation
        ? equation.internal + (equation.increment === "decreasing" ? -along : along)
        : along;
      if (chainage >= from && chainage < to) found.push(chainage);
    }
    return found;
  }
}

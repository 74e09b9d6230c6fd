import { type StationEquation, StationEquations } from "@groma/layer/tools";

/** Longitude and latitude of vertices, radians. */
type Places = readonly (readonly [number, number])[];

/** Station equations of an alignment, and the line that they belong to. */
export interface Stationing {
  /** As it was opened: a line that was changed since has other stations. */
  readonly vertices: Places;
  /** By the distance from the start of the line, metres. */
  readonly equations: readonly StationEquation[];
}

/** What the profile of a line has besides its vertices. */
export interface LineSettings {
  /** Of the strip, metres. */
  readonly width: number;
  /** Chainage at the start of the line, metres. */
  readonly start: number;
  readonly stationing?: Stationing | undefined;
}

/** Of longitudes and latitudes of one vertex, radians: a millimetre. */
const SAME = 1.5e-10;

/** Whether two lines have the same vertices, to a millimetre. */
export function samePlaces(one: Places, other: Places): boolean {
  const same = (a: number, b: number | undefined) => Math.abs(a - (b ?? Number.NaN)) < SAME;
  return (
    one.length === other.length &&
    one.every(([east, north], at) => same(east, other[at]?.[0]) && same(north, other[at]?.[1]))
  );
}

/** The stations of a line, metres; undefined where they are its chainages, and where the line is no longer the one that had others. */
export function stationsOn({ start, stationing }: LineSettings, line: Places): StationEquations | undefined {
  if (!stationing || stationing.equations.length === 0) return undefined;
  const { vertices, equations } = stationing;
  if (!samePlaces(line, vertices)) return undefined;
  return new StationEquations(
    equations.map(({ internal, ...equation }) => ({ ...equation, internal: internal + start })),
  );
}

/**
 * The settings in what the browser has kept of lines, by the ids of these. What is none is passed over: anybody may have
 * written there.
 * @param kept JSON
 */
export function settingsIn(kept: string): Map<string, LineSettings> {
  const { profiles } = JSON.parse(kept) as { profiles?: unknown };
  const found = new Map<string, LineSettings>();
  if (!isObject(profiles)) return found;
  for (const [id, given] of Object.entries(profiles)) {
    const { width, start, stationing } = isObject(given) ? given : ({} as Record<string, unknown>);
    if (!isNumber(width) || !(width > 0) || !isNumber(start)) continue;
    found.set(id, { width, start, ...(isStationing(stationing) && { stationing }) });
  }
  return found;
}

function isStationing(value: unknown): value is Stationing {
  if (!isObject(value) || !Array.isArray(value.vertices) || !Array.isArray(value.equations)) return false;
  const places = value.vertices.every((one) => Array.isArray(one) && one.length === 2 && one.every(isNumber));
  const numbers = value.equations.every(
    (one) => isObject(one) && isNumber(one.internal) && isNumber(one.ahead),
  );
  const distinct = new Set(value.equations.map((one) => one?.internal)).size === value.equations.length;
  return places && numbers && distinct;
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null;
}

function isNumber(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

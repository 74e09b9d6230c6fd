/** A profile as a link keeps it. */
export interface SharedProfile {
  readonly name: string;
  /** Longitude and latitude of each vertex (radians, WGS 84), and its height above the ellipsoid (metres). */
  readonly line: readonly (readonly [number, number, number])[];
  /** Of the strip, metres. */
  readonly width: number;
  /** Chainage at the start of the line, metres. */
  readonly start: number;
  /** Where stations are counted anew, by the distance from the start, metres; see `StationEquations`. */
  readonly equations?: readonly SharedEquation[] | undefined;
}

/** A station equation of the line. */
export interface SharedEquation {
  readonly internal: number;
  readonly ahead: number;
  readonly increment?: "increasing" | "decreasing" | undefined;
}

/** The profile that a value is, and nothing more than that; undefined where it is none. */
export function profileOf(value: Record<string, unknown>): SharedProfile | undefined {
  const { name, line, width, start, equations } = value;
  if (typeof name !== "string" || !isNumber(start) || !isNumber(width) || width <= 0) return undefined;
  if (!Array.isArray(line) || line.length < 2 || !line.every(isPlace)) return undefined;
  if (equations === undefined) return { name, line, width, start };
  if (!Array.isArray(equations) || !equations.every(isEquation)) return undefined;
  const distinct = new Set(equations.map(({ internal }) => internal)).size === equations.length;
  return distinct ? { name, line, width, start, equations } : undefined;
}

function isPlace(value: unknown): value is [number, number, number] {
  if (!Array.isArray(value) || value.length !== 3 || !value.every(isNumber)) return false;
  return Math.abs(value[0]) <= Math.PI && Math.abs(value[1]) <= Math.PI / 2;
}

function isEquation(value: unknown): value is SharedEquation {
  const { internal, ahead, increment = "increasing" } = (value ?? {}) as Record<string, unknown>;
  return isNumber(internal) && isNumber(ahead) && ["increasing", "decreasing"].includes(increment as string);
}

function isNumber(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

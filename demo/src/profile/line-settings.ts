/** What the profile of a line has besides its vertices. */
export interface LineSettings {
  /** Of the strip, metres. */
  readonly width: number;
  /** Chainage at the start of the line, metres. */
  readonly start: number;
}

/**
 * The settings in what the browser has kept of lines, by the ids of these. What is none is passed over: anybody may have
 * written there.
 * @param kept JSON
 */
export function settingsIn(kept: string): Map<string, LineSettings> {
  const { profiles } = JSON.parse(kept) as { profiles?: unknown };
  const found = new Map<string, LineSettings>();
  if (typeof profiles !== "object" || profiles === null) return found;
  for (const [id, given] of Object.entries(profiles)) {
    const { width, start } = (given ?? {}) as Partial<Record<keyof LineSettings, unknown>>;
    if (!isNumber(width) || !(width > 0) || !isNumber(start)) continue;
    found.set(id, { width, start });
  }
  return found;
}

function isNumber(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

/** What a volume is measured against, as it is kept and saved; see `VolumeOptions`. */
export type VolumeBaseSetting =
  | { readonly kind: "lowest" | "highest" | "plane" | "ring" }
  /** Metres, in the data set's own height system. */
  | { readonly kind: "height"; readonly height: number }
  /** Another data set, by its name, and by its `identity` where that is known. */
  | { readonly kind: "cloud"; readonly dataset: string; readonly identity?: string | undefined };

/** How a volume is measured. */
export interface VolumeSettings {
  /** Default: `lowest`. */
  readonly base?: VolumeBaseSetting | undefined;
  /** Classes of the points that make the surface. Default: all. */
  readonly classes?: readonly number[] | undefined;
}

/** Kinds of bases that need nothing else. */
const PLAIN: ReadonlySet<unknown> = new Set(["lowest", "highest", "plane", "ring"]);

/** Settings as they stand in a file; undefined where they are none. */
export function volumeSettingsOf(saved: unknown): VolumeSettings | undefined {
  if (!isObject(saved)) return undefined;
  const { base, classes, ...rest } = saved;
  const known = base === undefined || isBase(base);
  const listed = classes === undefined || (Array.isArray(classes) && classes.every(isClass));
  if (!known || !listed || Object.keys(rest).length > 0) return undefined;
  return { ...(base !== undefined && { base }), ...(classes !== undefined && { classes }) };
}

function isBase(value: unknown): value is VolumeBaseSetting {
  if (!isObject(value)) return false;
  if (value.kind === "height") return Number.isFinite(value.height);
  if (value.kind === "cloud") {
    return typeof value.dataset === "string" && ["string", "undefined"].includes(typeof value.identity);
  }
  return PLAIN.has(value.kind);
}

function isClass(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 0 && (value as number) <= 255;
}

/** @internal */
export function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

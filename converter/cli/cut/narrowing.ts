import { readFile } from "node:fs/promises";
import { GromaError } from "@groma/georef";
import type { KnownPoints, Narrowing, PointSelection } from "@groma/layer/export";
import type { RecordedPoints } from "@groma/layer/query";
import type { Clip } from "@groma/layer/tools";
import { spaceOf } from "./place.js";

/** A file with clips cannot be read. Codes: CLIPS_NOT_FOUND, CLIPS_SYNTAX. */
class ClipsFileError extends GromaError {
  static override readonly kind = "ClipsFileError";
}

/** What of the points is written, by what is recorded of them and by volumes. */
export interface NarrowingOptions {
  /** Classes that are kept. */
  readonly classes?: readonly number[];
  /** Kinds of returns that are kept. */
  readonly returns?: NonNullable<Narrowing["filter"]>["returns"];
  /** Attributes, and the least and greatest value that is kept of each. */
  readonly range?: readonly (readonly [name: string, least: number, greatest: number])[];
  /** JSON file with the volumes. */
  readonly clips?: string;
}

type Narrow = <S extends PointSelection>(selection: S & { readonly origin: RecordedPoints }) => Promise<S>;

/**
 * Reads what is to be left of points, and says how a selection is narrowed to that.
 * @throws ClipsFileError; the function StyleError STYLE_FILTER, STYLE_CLIP; CrsError, RecordError, PlacementError
 */
export async function narrowing({ classes, returns, range, clips: file }: NarrowingOptions): Promise<Narrow> {
  const { narrowed } = await import("@groma/layer/export");
  const clips = file === undefined ? undefined : await readClips(file);
  const ranges = range && Object.fromEntries(range.map(([name, ...limits]) => [name, limits]));
  const filter = returns || ranges ? { returns, ranges } : undefined;
  const asked = ranges && "ellipsoidalHeight" in ranges;
  return async (selection) => {
    const { origin } = selection;
    const space = clips || asked ? await spaceOf(origin) : undefined;
    const known: KnownPoints = { space, attributes: [...HEIGHTS, ...origin.source.attributes] };
    return narrowed(
      {
        ...selection,
        ...(classes && { classes: new Set(classes) }),
        ...(asked && { geodetic: space?.geodetic }),
      },
      { clips, filter },
      known,
    );
  };
}

/** Attributes that layers add to those that are recorded. */
const HEIGHTS = [
  { name: "elevation", kind: "scalar" },
  { name: "ellipsoidalHeight", kind: "scalar" },
] as const;

async function readClips(file: string): Promise<Clip[]> {
  const refuse = (code: string, cause: string) =>
    new ClipsFileError({
      ...{ code: `CLIPS_${code}`, file, cause },
      fix: "give a JSON file with a list of boxes, planes and polygons, as JSON.stringify([...layer.clips]) writes them",
    });
  const text = await readFile(file, "utf8").catch((error: NodeJS.ErrnoException) => {
    throw refuse("NOT_FOUND", `it cannot be read (${error.code})`);
  });
  let value: unknown;
  try {
    value = JSON.parse(text.replace(/^\uFEFF/, ""));
  } catch {
    throw refuse("SYNTAX", "it is no JSON");
  }
  if (!Array.isArray(value)) throw refuse("SYNTAX", "it has no list of volumes");
  // A ClipSet looks at each of them.
  return value as Clip[];
}

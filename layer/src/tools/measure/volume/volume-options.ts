import { MeasureError } from "../../../errors/index.js";
import { type Kinds, kindOf, signal, some } from "../../../options/index.js";
import type { PointOrigin } from "../../../query/index.js";
import type { MeasuredCloud } from "../vertex/vertex.js";
import type { WorthOptions } from "../worth/point-errors.js";
import type { VolumeBase } from "./base.js";
import { BASES, isPlainBase, noBase } from "./check-base.js";
import type { VolumeWorker } from "./in-worker.js";

/** A data set whose points can be asked for; a `PointCloud` is one. */
export type VolumeCloud = MeasuredCloud & PointOrigin;

/** What a volume is measured against, and how. */
export interface VolumeOptions extends WorthOptions {
  /** Default: `lowest`. Heights are metres in the data set's own height system. */
  readonly base?:
    | Exclude<VolumeBase, { kind: "surface" }>
    | { readonly kind: "cloud"; readonly cloud: VolumeCloud }
    | undefined;
  /** Classes of the points that make the surface; those of the ground are 2. Default: all. */
  readonly classes?: ReadonlySet<number> | readonly number[] | undefined;
  /** Stops the work, that of the worker too. */
  readonly signal?: AbortSignal | undefined;
  /** Hears the share of the work that is done, 0 to 1; the first half is reading. */
  readonly onProgress?: ((share: number) => void) | undefined;
  /** Makes the worker, where the application's bundler or policy needs its own way. */
  readonly createWorker?: (() => VolumeWorker) | undefined;
}

const isFunction = (given: unknown): given is () => never => typeof given === "function";

const classes = kindOf(
  "a set or an array of class numbers",
  (given): given is NonNullable<VolumeOptions["classes"]> =>
    (given instanceof Set || Array.isArray(given)) &&
    [...given].every((one) => Number.isInteger(one) && one >= 0),
);

const KINDS: Kinds<VolumeOptions> = {
  base: kindOf("a base", (given): given is NonNullable<VolumeOptions["base"]> => given !== null),
  // Checked with each data set.
  precision: kindOf(
    "a precision",
    (given): given is NonNullable<VolumeOptions["precision"]> => given !== undefined,
  ),
  classes,
  signal,
  onProgress: kindOf("a function", isFunction),
  createWorker: kindOf("a function", isFunction),
};

/** @throws MeasureError MEASURE_OPTION for an option that there is not, or that is none of its kind */
export function checkVolumeOptions(given: VolumeOptions, file: string): VolumeOptions {
  const options = some(KINDS).read(given, {
    name: "options",
    context: undefined,
    refuse: (cause, fix) => {
      throw new MeasureError({ code: "MEASURE_OPTION", file, cause, fix });
    },
  });
  const { base } = options;
  const isCloud = base?.kind === "cloud" && typeof base.cloud?.query === "function";
  if (base !== undefined && !isCloud && !isPlainBase(base)) throw noBase(base, [...BASES, "cloud"]);
  return options;
}

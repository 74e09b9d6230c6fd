import { PdalError } from "./errors.js";
import type { Dimension, Probe, Stored } from "./probe.js";

/** The form of the LAS 1.4 file that PDAL writes for the core. */
export interface Form extends Stored {
  /** Whether coordinates stay the integers that they are in the LAS files that PDAL reads. */
  readonly asStored: boolean;
  /** 6, 7 or 8: the one that has room for colours and near infrared. */
  readonly pointFormat: 6 | 7 | 8;
  /** Dimensions whose values LAS's field cannot hold: kept in an extra attribute, the field is zero. */
  readonly keptAside: readonly string[];
  /** Floating-point dimensions that LAS keeps as whole numbers. */
  readonly rounded: readonly string[];
  /** Bytes of a record. */
  readonly recordLength: number;
}

/** Fields of the point formats 6 to 8 by PDAL's names, with the least and greatest value that they hold. */
const FIELDS: ReadonlyMap<string, readonly [number, number]> = new Map(
  Object.entries<readonly [number, number]>({
    Intensity: [0, 65535],
    ReturnNumber: [0, 15],
    NumberOfReturns: [0, 15],
    ScanChannel: [0, 3],
    ScanDirectionFlag: [0, 1],
    EdgeOfFlightLine: [0, 1],
    ClassFlags: [0, 15],
    Synthetic: [0, 1],
    KeyPoint: [0, 1],
    Withheld: [0, 1],
    Overlap: [0, 1],
    Classification: [0, 255],
    UserData: [0, 255],
    PointSourceId: [0, 65535],
    Red: [0, 65535],
    Green: [0, 65535],
    Blue: [0, 65535],
    Infrared: [0, 65535],
  }),
);

/** Dimensions that LAS holds as the numbers that they are, coordinates aside; scan angles to 0.006 degrees. */
const AS_THEY_ARE = new Set(["X", "Y", "Z", "GpsTime", "ScanAngleRank"]);

/** Often given as shares of one, of which whole numbers would leave nothing. */
const SHARES = new Set(["Intensity", "Red", "Green", "Blue", "Infrared"]);

const BASE_LENGTH = { 6: 30, 7: 36, 8: 38 } as const;

/** Name of the attribute that keeps the values of a field that cannot hold them. */
export const asideName = (dimension: string): string => `${dimension}AsRead`;

/**
 * How the points of a job are written so that nothing is lost but what is stated.
 *
 * @param stored scale and offset; see {@link commonScale}
 */
export function formOf({ dimensions, stored: before }: Probe, stored: Stored): Form {
  const has = (name: string) => dimensions.some((dimension) => dimension.name === name);
  const pointFormat = has("Infrared") ? 8 : ["Red", "Green", "Blue"].some(has) ? 7 : 6;
  const keptAside = dimensions.filter(isTooMuch).map(({ name }) => name);
  const rounded = dimensions
    .filter(({ name, type }) => FIELDS.has(name) && type === "floating" && !keptAside.includes(name))
    .map(({ name }) => name);
  const extra = dimensions.filter(({ name }) => !FIELDS.has(name) && !AS_THEY_ARE.has(name));
  const extraBytes = extra.reduce((sum, { size }) => sum + size, 0);
  const recordLength = BASE_LENGTH[pointFormat] + extraBytes + 8 * keptAside.length;
  const { scale, offset } = stored;
  const asStored = JSON.stringify(before) === JSON.stringify({ scale, offset });
  return { scale, offset, asStored, pointFormat, keptAside, rounded, recordLength };
}

function isTooMuch({ name, type, min, max }: Dimension): boolean {
  const range = FIELDS.get(name);
  if (range === undefined) return false;
  const share = type === "floating" && SHARES.has(name) && max > 0 && max <= 1;
  return share || min < range[0] || max > range[1];
}

/** Finest step of linear units where a data set is no small object: a tenth of a millimetre, where they are metres. */
const LINEAR_STEP = 1e-4;
/** A tenth of a millimetre on the ground, degrees. */
const ANGULAR_STEP = 1e-9;
/** Steps over the extent at which a small object is stored: the digits of a float32. */
const SMALL_OBJECT_DIGITS = 6;
/** No instrument is finer. */
const FINEST_STEP = 1e-9;
/** Integers of LAS have 31 bits besides the sign; a few are left free at the edge. */
const MOST_STEPS = 2 ** 31 - 1024;

/**
 * One scale and offset for all jobs of a conversion, so that their points can stand in one file. Where all of them read
 * LAS that is stored alike and leave coordinates alone, it stays as it is. Else the step is a power of ten: a tenth of a
 * millimetre, finer for small objects, coarser only where the integers of LAS would not suffice.
 *
 * @param geographic whether x and y are degrees
 * @param wish the step that the user wants, of degrees in plane only
 * @throws PdalError PDAL_SCALE when the integers do not suffice for it
 */
export function commonScale(probes: readonly Probe[], geographic: boolean, wish?: number): Stored {
  const min = [0, 1, 2].map((axis) => Math.min(...probes.map((one) => one.min[axis]!)));
  const max = [0, 1, 2].map((axis) => Math.max(...probes.map((one) => one.max[axis]!)));
  const kept = wish === undefined ? storedOfAll(probes) : undefined;
  if (kept && fits(kept, min, max)) return kept;
  const offset = min.map(Math.floor) as [number, number, number];
  const plane = wish ?? stepFor(Math.max(max[0]! - offset[0]!, max[1]! - offset[1]!), geographic);
  const height = (geographic ? undefined : wish) ?? stepFor(max[2]! - offset[2]!, false);
  const stored = { scale: [plane, plane, height] as const, offset };
  if (fits(stored, min, max)) return stored;
  const extent = Math.max(...min.map((least, axis) => max[axis]! - least));
  throw new PdalError({
    code: "PDAL_SCALE",
    file: probes[0]!.job.name,
    cause: `an extent of ${extent} does not fit into the 32-bit integers of LAS at a scale factor of ${plane}`,
    fix: "give a larger --scale, or omit it",
  });
}

function storedOfAll(probes: readonly Probe[]): Stored | undefined {
  const [first] = probes;
  const text = JSON.stringify(first?.stored);
  return probes.every((one) => JSON.stringify(one.stored) === text) ? first?.stored : undefined;
}

function stepFor(extent: number, geographic: boolean): number {
  const usual = geographic ? ANGULAR_STEP : LINEAR_STEP;
  if (extent < FINEST_STEP) return usual;
  const small = Math.max(FINEST_STEP, powerOfTen(Math.floor(Math.log10(extent)) - SMALL_OBJECT_DIGITS));
  const suffices = powerOfTen(Math.ceil(Math.log10(extent / MOST_STEPS)));
  return Math.max(geographic ? usual : Math.min(usual, small), suffices);
}

/** The number that is nearest to the power, which a product of tenths is not. */
function powerOfTen(exponent: number): number {
  return Number(`1e${exponent}`);
}

function fits({ scale, offset }: Stored, min: readonly number[], max: readonly number[]): boolean {
  return [0, 1, 2].every((axis) =>
    [min[axis]!, max[axis]!].every((value) => Math.abs((value - offset[axis]!) / scale[axis]!) <= MOST_STEPS),
  );
}

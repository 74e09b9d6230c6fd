import { requireKind } from "../errors/arguments.js";
import type { GridWindow } from "../grid/window.js";
import { ByteReader } from "./bytes.js";
import { CHOICE, DIRECTIONS, KINDS, MAGIC, TURNED_PROJECTION, VERSION } from "./format.js";
import { readGridValues } from "./grid-values.js";
import { DEGREE_MAX } from "./projection.js";
import type {
  ChoiceStep,
  EllipsoidAxes,
  Patch,
  Patchwork,
  ShiftStep,
  Step,
  Transformation,
  Way,
} from "./step.js";

/** Channels that a step of a kind needs of its grid. */
const CHANNELS = { horizontalShift: 2, verticalShift: 1 } as const;
const CHANNELS_MAX = 8;

/** Bytes of a patch of degree 0: nothing shorter can follow the count of patches. */
const PATCH_MIN = 4 * 8 + 1 + 2 * 8;

/**
 * The transformation that {@link encodeTransformation} wrote.
 *
 * @param file name for error messages
 * @throws RecordError RECORD_INVALID when the bytes are no transformation, RECORD_VERSION when they are of a later
 *   version, RECORD_TRUNCATED when they end early
 * @throws ArgumentError ARGUMENT_INVALID
 */
export function decodeTransformation(bytes: Uint8Array, file: string): Transformation {
  requireKind(bytes, "bytes", "decodeTransformation: bytes");
  const reader = new ByteReader(bytes, file);
  for (const byte of MAGIC) reader.check(reader.u8() === byte, "a transformation that does not start as one");
  const version = reader.u8();
  if (version !== VERSION) {
    throw reader.fault(
      "RECORD_VERSION",
      `its georeference record is of version ${version}, known is ${VERSION}`,
    );
  }
  const count = reader.u8();
  const steps: Step[] = [];
  for (let i = 0; i < count; i++) {
    const number = reader.u8();
    const turned = number === TURNED_PROJECTION;
    if (number === CHOICE) {
      reader.check(i === 1 && count > 2, "a choice that does not follow the projection");
      steps.push(readChoice(reader));
      continue;
    }
    const kind = turned ? "projection" : KINDS[number];
    reader.check(kind !== undefined, "a step of an unknown kind");
    reader.check((kind === "projection") === (i === 0), "a projection that is not its first step");
    reader.check((kind === "geocentric") === (i === count - 1), "a last step that does not lead to ECEF");
    steps.push(turned ? readTurned(reader) : readStep(reader, kind));
  }
  reader.check(steps.length > 0, "no steps");
  reader.check(reader.remaining === 0, "bytes after its end");
  return { steps };
}

function readTurned(reader: ByteReader): Step {
  const [longitude, latitude] = [reader.f64("a centre"), reader.f64("a centre")];
  reader.check(Math.abs(latitude) <= Math.PI / 2, `a centre at the latitude ${latitude}`);
  return { kind: "projection", patchwork: { ...readPatchwork(reader), centre: [longitude, latitude] } };
}

function readChoice(reader: ByteReader): ChoiceStep {
  const count = reader.u8();
  reader.check(count > 0, "a choice without ways");
  return { kind: "choice", ways: Array.from({ length: count }, () => readWay(reader)) };
}

function readWay(reader: ByteReader): Way {
  const number = () => reader.f64("an edge of an area");
  const [minX, minY, maxX, maxY] = [number(), number(), number(), number()];
  reader.check(minX < maxX && minY < maxY, "an area without extent");
  const steps = Array.from({ length: reader.u8() }, () => {
    const kind = KINDS[reader.u8()];
    reader.check(kind !== undefined && !ENDS.has(kind), "a step that a way cannot have");
    return readShift(reader, kind as ShiftStep["kind"]);
  });
  return { area: { minX, minY, maxX, maxY }, steps };
}

/** Steps that stand once, before or after a choice. */
const ENDS: ReadonlySet<Step["kind"]> = new Set(["projection", "geocentric"]);

function readStep(reader: ByteReader, kind: Exclude<Step["kind"], "choice">): Step {
  if (kind === "projection") return { kind, patchwork: readPatchwork(reader) };
  if (kind === "geocentric") return { kind, ellipsoid: readEllipsoid(reader) };
  return readShift(reader, kind);
}

function readShift(reader: ByteReader, kind: ShiftStep["kind"]): ShiftStep {
  switch (kind) {
    case "height":
      return { kind, metresPerUnit: reader.nonZero("a height unit") };
    case "horizontalShift": {
      const direction = DIRECTIONS[reader.u8()];
      reader.check(direction !== undefined, "a grid shift of unknown direction");
      return { kind, direction, window: readWindow(reader, CHANNELS[kind]) };
    }
    case "verticalShift": {
      const multiplier = reader.f64("a multiplier of heights");
      return { kind, multiplier, window: readWindow(reader, CHANNELS[kind]) };
    }
    case "datumShift": {
      const from = readEllipsoid(reader);
      const to = readEllipsoid(reader);
      const number = () => reader.f64("a datum shift");
      const translation = [number(), number(), number()] as const;
      const matrix = Array.from({ length: 9 }, number);
      return { kind, from, to, translation, matrix, keepHeight: readFlag(reader) };
    }
  }
}

function readFlag(reader: ByteReader): boolean {
  const value = reader.u8();
  reader.check(value <= 1, `a flag of ${value}`);
  return value === 1;
}

function readEllipsoid(reader: ByteReader): EllipsoidAxes {
  const a = reader.positive("an equatorial radius");
  const f = reader.f64("a flattening");
  reader.check(f >= 0 && f < 1, `a flattening of ${f}`);
  return { a, f };
}

function readPatchwork(reader: ByteReader): Patchwork {
  const bound = reader.positive("a bound of the projection");
  const count = reader.u16();
  reader.check(count > 0, "a projection without patches");
  reader.require(count * PATCH_MIN);
  return { patches: Array.from({ length: count }, () => readPatch(reader)), bound };
}

function readPatch(reader: ByteReader): Patch {
  const number = () => reader.f64("an edge of a patch");
  const [minX, minY, maxX, maxY] = [number(), number(), number(), number()];
  reader.check(minX < maxX && minY < maxY, "a patch without area");
  const degree = reader.u8();
  reader.check(degree >= 1 && degree <= DEGREE_MAX, `a patch of degree ${degree}`);
  const terms = 2 * (degree + 1) ** 2;
  reader.require(8 * terms);
  const coefficients = Float64Array.from({ length: terms }, () => reader.f64("a coefficient"));
  return { minX, minY, maxX, maxY, degree, coefficients };
}

function readWindow(reader: ByteReader, channelsNeeded: number): GridWindow {
  const grid = reader.text("a name of a grid");
  const west = reader.f64("a western edge");
  const south = reader.f64("a southern edge");
  const stepLongitude = reader.positive("a step of longitude");
  const stepLatitude = reader.positive("a step of latitude");
  const columns = reader.u32();
  const rows = reader.u32();
  reader.check(columns >= 2 && rows >= 2, `a grid of ${columns} × ${rows} nodes`);
  const channels = reader.u8();
  reader.check(channels >= channelsNeeded && channels <= CHANNELS_MAX, `a grid of ${channels} channels`);
  const unit = reader.positive("a unit of grid values");
  const noData = readFlag(reader) ? reader.f64("a value for no data") : undefined;
  // A value takes a byte at least: this also keeps the product of hostile sizes from being allocated.
  reader.require(columns * rows * channels);
  const values = readGridValues(reader, { columns, rows, channels });
  const shape = { grid, west, south, stepLongitude, stepLatitude, columns, rows, channels, values, unit };
  return noData === undefined ? shape : { ...shape, noData };
}

/**
 * What every error of Groma says: a stable code to program against, the file (or address) it is about,
 * what went wrong and what the reader can do about it.
 */
export interface Fault {
  /** Stable, upper case with underscores, e.g. `CRS_MISSING`. Never reused for another meaning. */
  readonly code: string;
  /** The file, address or option that the fault is about. */
  readonly file: string;
  /** What was found, as a clause without a closing stop. */
  readonly cause: string;
  /** What to do about it, as a clause without a closing stop. */
  readonly fix: string;
}

/** Plain form of an error that can cross a worker or process boundary. */
export interface FaultWire extends Fault {
  readonly kind: string;
}

/**
 * Base of every error that Groma throws for the world's faults (bad files, servers, coordinates).
 * Its message reads `CODE: file: cause. fix.`, the form that the command line prints.
 */
export class GromaError extends Error implements Fault {
  /** Name of the class, which stays when a build shortens the names of classes. Each class has its own. */
  static readonly kind: string = "GromaError";

  readonly code: string;
  readonly file: string;
  override readonly cause: string;
  readonly fix: string;

  constructor(fault: Fault) {
    super(`${fault.code}: ${fault.file}: ${fault.cause}. ${sentence(fault.fix)}.`);
    this.name = new.target.kind;
    this.code = fault.code;
    this.file = fault.file;
    this.cause = fault.cause;
    this.fix = fault.fix;
  }

  /** Plain object for `postMessage`; {@link GromaError.revive} makes an error of the same kind of it. */
  toWire(): FaultWire {
    return { kind: this.name, code: this.code, file: this.file, cause: this.cause, fix: this.fix };
  }

  /** The error that `toWire` was called on, as far as the kinds given know its name. */
  static revive(wire: FaultWire, kinds: readonly GromaErrorClass[] = []): GromaError {
    const Kind = kinds.find(({ kind }) => kind === wire.kind) ?? GromaError;
    return new Kind(wire);
  }
}

type GromaErrorClass = { readonly kind: string } & (new (fault: Fault) => GromaError);

/** With a capital letter; a fix that begins with a command keeps its own. */
function sentence(clause: string): string {
  return clause.charAt(0).toUpperCase() + clause.slice(1);
}

/** A coordinate reference system is missing, unknown or cannot be used. Codes start with `CRS_`. */
export class CrsError extends GromaError {
  static override readonly kind = "CrsError";
}

/** A function was called with what it does not take: a mistake of the code that calls it. Code: ARGUMENT_INVALID. */
export class ArgumentError extends GromaError {
  static override readonly kind = "ArgumentError";
}

/** A point or node cannot be placed on the globe to the tolerance asked for. Codes start with `PLACE_`. */
export class PlacementError extends GromaError {
  static override readonly kind = "PlacementError";
}

/** A georeference record in a file cannot be read. Codes start with `RECORD_`. */
export class RecordError extends GromaError {
  static override readonly kind = "RecordError";
}

/**
 * Control points do not tell where a data set is. Codes: CONTROL_TOO_FEW, CONTROL_DEGENERATE (all in one place),
 * CONTROL_COLLINEAR, CONTROL_RANGE (no place on earth), CONTROL_MISMATCH (no similarity leads from one to the other).
 */
export class ControlError extends GromaError {
  static override readonly kind = "ControlError";
}

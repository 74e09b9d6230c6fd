import { CrsError, type Fault, type FaultWire, GromaError, PlacementError, RecordError } from "@groma/georef";

/**
 * What keeps bytes away for a time, so that asking again helps.
 * - `busy`: the server asks for a pause (HTTP 429 or 503)
 * - `failing`: the server fails, or its answers break off
 * - `silent`: the server was asked, and sends nothing
 * - `unreachable`: there is no connection to the server
 */
export type Outage = "busy" | "failing" | "silent" | "unreachable";

/** The bytes of a data set cannot be had: server, network or file. Codes start with `SOURCE_`. */
export class SourceError extends GromaError {
  static override readonly kind = "SourceError";

  /** Why asking again later may help; undefined: it does not. */
  readonly outage: Outage | undefined;

  constructor(fault: Fault & { readonly outage?: Outage | undefined }) {
    super(fault);
    this.outage = fault.outage;
  }
}

/** The bytes are there, but they are not what the format's specification says. Codes start with `FORMAT_`. */
export class FormatError extends GromaError {
  static override readonly kind = "FormatError";
}

/** A node's points cannot be decoded, or the decoder itself is not to be had. Codes start with `DECODE_`. */
export class DecodeError extends GromaError {
  static override readonly kind = "DecodeError";
}

/** An application gave an option that does not exist or that nothing can be done with. Codes start with `STYLE_`. */
export class StyleError extends GromaError {
  static override readonly kind = "StyleError";
}

/** A frame of a layer could not be drawn. Codes start with `DRAW_`. */
export class DrawError extends GromaError {
  static override readonly kind = "DrawError";
}

/** What was asked to be measured has no such value, or a file of measurements cannot be read. Codes start with `MEASURE_`. */
export class MeasureError extends GromaError {
  static override readonly kind = "MeasureError";
}

/** A link to a view cannot be read. Codes start with `LINK_`. */
export class LinkError extends GromaError {
  static override readonly kind = "LinkError";
}

const kinds = [
  ...[SourceError, FormatError, DecodeError, StyleError, MeasureError, LinkError],
  ...[CrsError, PlacementError, RecordError],
];

/**
 * Any thrown value as a plain object that survives `postMessage`. What is not Groma's own error becomes
 * a {@link DecodeError} with the code given, so that a fault never crosses the boundary without a code.
 */
export function toWire(thrown: unknown, fallback: { code: string; file: string; fix: string }): FaultWire {
  if (thrown instanceof GromaError) return thrown.toWire();
  const cause = thrown instanceof Error ? thrown.message : String(thrown);
  return new DecodeError({ ...fallback, cause }).toWire();
}

/** The error that {@link toWire} was given, of the same class and with the same four fields. */
export function fromWire(wire: FaultWire): GromaError {
  return GromaError.revive(wire, kinds);
}

/**
 * Calls a listener of the application's. What it throws is reported, as browsers do with listeners of their own events, and
 * ends nothing that this library does.
 */
export function callListener(call: () => void): void {
  try {
    call();
  } catch (thrown) {
    reportError(thrown);
  }
}

/** True for what an aborted `AbortSignal` throws: a wish of the caller's, never a fault. */
export function isAbort(thrown: unknown): boolean {
  return thrown instanceof Error && thrown.name === "AbortError";
}

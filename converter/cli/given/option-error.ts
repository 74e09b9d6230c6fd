import { GromaError } from "@groma/georef";

/** The command line was not understood, or asks for two things that exclude each other. Codes: OPTION_*. */
export class OptionError extends GromaError {
  static override readonly kind = "OptionError";
}

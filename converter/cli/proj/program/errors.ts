import { GromaError } from "@groma/georef";

/**
 * PROJ's programs are missing, too old, or do not answer as they should. Codes: PROJ_MISSING, PROJ_VERSION,
 * PROJ_FAILED (the program ended with an error), PROJ_OUTPUT (its answer cannot be read), PROJ_GRID (a grid file
 * cannot be found or read).
 */
export class ProjError extends GromaError {
  static override readonly kind = "ProjError";
}

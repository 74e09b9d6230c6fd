import { GromaError } from "@groma/georef";

/**
 * PDAL is not there, failed, or gave something else than it announced.
 * Codes: PDAL_MISSING, PDAL_FAILED, PDAL_PIPELINE, PDAL_EMPTY, PDAL_COORDINATES, PDAL_SCALE, PDAL_MISMATCH.
 */
export class PdalError extends GromaError {
  static override readonly kind = "PdalError";
}

import { GromaError } from "../errors.js";

/**
 * Control points do not tell where a data set is. Codes: CONTROL_TOO_FEW, CONTROL_DEGENERATE (all in one place),
 * CONTROL_COLLINEAR, CONTROL_RANGE (no place on earth), CONTROL_MISMATCH (no similarity leads from one to the other).
 */
export class ControlError extends GromaError {}

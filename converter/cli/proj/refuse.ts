import { CrsError } from "@groma/georef";
import type { StepText } from "./step-text.js";

/** What can be done where no operation of PROJ can be followed. */
export const OTHER_WAY =
  "transform the scan with PDAL or another tool that runs PROJ on every point, or convert with --engine proj4js";

/** An operation that PROJ can do and Groma cannot follow; `what` names what is in the way, without a closing stop. */
export function refuseStep({ name, inverse }: StepText, what?: string): CrsError {
  return new CrsError({
    code: "CRS_OPERATION_UNSUPPORTED",
    file: "PROJ",
    cause: `the step "${inverse ? "inv " : ""}${name}"${what === undefined ? "" : ` with ${what}`} is not supported`,
    fix: OTHER_WAY,
  });
}

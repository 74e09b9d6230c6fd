import { CrsError } from "../errors/errors.js";

/** What to do when a CRS text cannot be used: the same for all of them. */
const GIVE_ANOTHER =
  "give the coordinate reference system yourself: the option crs of the layer, --crs on the command line";

/** Thrown inside this room where the file is not known; `resolveCrs` adds it. */
export class Refusal extends Error {
  readonly code: "CRS_MISSING" | "CRS_UNKNOWN" | "CRS_UNSUPPORTED";
  readonly fix: string;

  constructor(code: Refusal["code"], cause: string, fix: string = GIVE_ANOTHER) {
    super(cause);
    this.code = code;
    this.fix = fix;
  }

  toError(file: string): CrsError {
    return new CrsError({ code: this.code, file, cause: this.message, fix: this.fix });
  }
}

/** The text is understood, but what it asks for is not done here. */
export function unsupported(cause: string, fix?: string): Refusal {
  return new Refusal("CRS_UNSUPPORTED", cause, fix);
}

/** Coordinates at an epoch: where they are at any other takes the operations of PROJ. */
export function atEpoch(): Refusal {
  return unsupported(
    "what coordinates of an epoch are today is worked out by PROJ alone",
    "convert the scan with groma where PROJ is installed, or leave the epoch out, which may cost some centimetres a year",
  );
}

/** The text, or a code in it, is not understood. */
export function unknown(cause: string, fix?: string): Refusal {
  return new Refusal("CRS_UNKNOWN", cause, fix);
}

import { MeasureError } from "../../errors/index.js";
import { instead } from "../../options/index.js";
import {
  MEASUREMENT_KINDS,
  type Measurement,
  type MeasurementKind,
  type MeasureUnits,
  type ReadingOptions,
  type WorthOptions,
} from "../measure/index.js";
import { noteOf } from "../measure/measurement/note.js";
import { volumeSettingsOf } from "../measure/measurement/volume-settings.js";
import type { MeasurementChange } from "./history.js";
import type { MeasureWords } from "./words.js";

/** Options of a `MeasureTool`. */
export interface MeasureToolOptions extends WorthOptions, Pick<ReadingOptions, "terrain" | "createWorker"> {
  /** How labels are written. Default: metres and degrees, in the reader's language. */
  readonly units?: MeasureUnits | undefined;
  /** What is said to people. Default: English. */
  readonly words?: Partial<MeasureWords> | undefined;
  /** Elements of the page that lie over the views, panels say: labels stand beside them. */
  readonly covering?: (() => readonly Element[]) | undefined;
  /** Hears what kept a record from being read. Default: `reportError`. */
  readonly onError?: ((thrown: unknown) => void) | undefined;
}

/** @throws MeasureError MEASURE_OPTION for a kind that there is not */
export function checkKind(kind: MeasurementKind): void {
  if (Object.hasOwn(MEASUREMENT_KINDS, kind)) return;
  throw refused(`there is no kind ${JSON.stringify(kind)}`, instead(kind, Object.keys(MEASUREMENT_KINDS)));
}

/**
 * @param name for messages
 * @throws MeasureError MEASURE_VERTICES where they are not as many as the kind needs, MEASURE_OPTION for settings of a volume
 *   or a note that are none
 */
export function checkChange(
  kind: MeasurementKind,
  { vertices, volume, note }: MeasurementChange,
  name: string,
): void {
  const { least, most } = MEASUREMENT_KINDS[kind];
  if (vertices && (vertices.length < least || vertices.length > most)) {
    const needed =
      least === most
        ? `${least}`
        : most === Number.POSITIVE_INFINITY
          ? `${least} or more`
          : `${least} to ${most}`;
    throw new MeasureError({
      code: "MEASURE_VERTICES",
      file: name,
      cause: `it cannot have ${vertices.length} vertices`,
      fix: `give ${needed}`,
    });
  }
  if (note !== undefined && !noteOf(note)) {
    throw refused(
      `the note of ${name} is none`,
      "give { text, camera } with a text of at most 20,000 characters",
    );
  }
  if (volume !== undefined && !volumeSettingsOf(volume)) {
    throw refused(
      `${name} cannot be measured against ${JSON.stringify(volume)?.slice(0, 80)}`,
      "give { base, classes } as VolumeSettings has them, a height as a number of metres",
    );
  }
}

/** @throws MeasureError as `checkKind` and `checkChange` */
export function checkMeasurement(measurement: Measurement): void {
  checkKind(measurement.kind);
  checkChange(measurement.kind, measurement, measurement.name);
}

function refused(cause: string, fix: string): MeasureError {
  return new MeasureError({ code: "MEASURE_OPTION", file: "MeasureTool", cause, fix });
}

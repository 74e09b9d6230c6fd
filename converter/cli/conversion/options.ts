import type { ProgressKind, Sampling } from "../given/choices.js";
import type { Given } from "../place/georeference.js";

/** What a conversion is told. */
export interface ConvertOptions extends Given {
  readonly sampling?: Sampling;
  readonly averageColors?: boolean;
  readonly threads?: number;
  readonly memory?: string;
  readonly tempDir?: string;
  readonly overwrite?: boolean;
  /** Refuses inputs that are empty or damaged, of which otherwise as much is read as can be. */
  readonly strict?: boolean;
  /** File of a PDAL pipeline that the inputs go through. */
  readonly pipeline?: string;
  /** Program of PDAL, or its folder. */
  readonly pdal?: string;
  /** Step of the integers for inputs that PDAL reads. */
  readonly scale?: number;
  readonly progress?: ProgressKind;
}

import { GromaError } from "@groma/georef";

/** A scan cannot be indexed in the page. Codes start with `INDEX_`; those with `INPUT_` are the core's own. */
export class IndexError extends GromaError {
  static override readonly kind = "IndexError";
}

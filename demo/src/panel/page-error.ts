import { GromaError } from "@groma/georef";

/** The page cannot do what it is asked to: its address, the browser, a file to be saved. Codes start with `PAGE_`. */
export class PageError extends GromaError {
  static override readonly kind = "PageError";
}

import { signal, some } from "./kinds.js";
import { optionPlace } from "./option-place.js";

/**
 * What stops a call on a data set; where none is given, a signal that is never aborted.
 * @throws StyleError STYLE_OPTION
 */
export function checkSignal(
  options: { readonly signal?: AbortSignal | undefined },
  file: string,
): AbortSignal {
  const checked = some<typeof options>({ signal }).read(options, optionPlace("options", file));
  return checked.signal ?? new AbortController().signal;
}

import { StyleError } from "../errors/index.js";
import type { Place } from "./kinds.js";

/**
 * Where an option stands that is refused as a StyleError.
 * @param file the data set's name, or the call where none is open yet
 * @param optionCode the error's code where the kind names no other
 */
export function optionPlace(name: string, file: string, optionCode = "STYLE_OPTION"): Place {
  return {
    name,
    context: undefined,
    refuse: (cause, fix, code = optionCode) => {
      throw new StyleError({ code, file, cause, fix });
    },
  };
}

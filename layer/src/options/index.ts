export { checkSignal } from "./check-signal.js";
export { frozen } from "./frozen.js";
export {
  above,
  colour,
  either,
  entriesOf,
  flag,
  inside,
  interval,
  type Kind,
  type Kinds,
  kindOf,
  list,
  number,
  oneOf,
  type Place,
  parts,
  signal,
  some,
  text,
  whole,
  withMethods,
} from "./kinds.js";
export { optionPlace } from "./option-place.js";
export { SHARED, shared } from "./shared.js";
export { closest, instead, listed, shown } from "./words.js";

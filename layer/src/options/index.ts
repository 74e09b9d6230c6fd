export { frozen } from "./frozen.js";
export {
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
  some,
  text,
  whole,
  withMethods,
} from "./kinds.js";
export { closest, instead, listed, shown } from "./words.js";

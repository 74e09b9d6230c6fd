import type { Kind } from "./kinds.js";
import { shown } from "./words.js";

/**
 * Property that marks what layers share, such as a budget: name of its class, and the version of the methods by which
 * layers use it, to be raised when these change. A page may hold two copies of this library, each with classes of its
 * own, of which `instanceof` knows one.
 */
export const SHARED = Symbol.for("@groma/layer shared");

/** An object with the mark given, whichever copy of the library made it. */
export function shared<Value extends object>(mark: `${string} ${number}`): Kind<Value> {
  const [name] = mark.split(" ");
  const valid = `a ${name}`;
  return {
    valid,
    read(given, place) {
      const found =
        typeof given === "object" && given !== null && SHARED in given ? given[SHARED] : undefined;
      if (found === mark) return given as Value;
      if (String(found).startsWith(`${name} `)) {
        return place.refuse(
          `${place.name} cannot be a ${name} of another version of @groma/layer`,
          "bundle one version of @groma/layer",
        );
      }
      return place.refuse(`${place.name} cannot be ${shown(given)}`, `use ${valid}`);
    },
  };
}

import { richFacts, styleOf } from "./scene.fixture.js";
import { completeStyle, type StyleParts } from "./style.js";

/** Those of a rich scan, and one of three components, which no colour can be of. */
export const attributes = [
  ...richFacts().attributes,
  { name: "normals", kind: "scalar", components: 3 },
] as const;
/** A data set that has them. */
export const cloud = { attributes, name: "a.copc.laz" };
/** The style that comes of what a caller gives, whatever that is. */
export const complete = (given: unknown, base = styleOf()) => completeStyle(given as StyleParts, base, cloud);

/** A stop of a gradient. */
export const stop = (at: unknown, color: unknown = [0, 0, 0]) => ({ at, color });

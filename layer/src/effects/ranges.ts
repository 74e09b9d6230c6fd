import type { SceneFacts } from "./facts.js";
import type { PointCloudStyle } from "./style.js";

/** Values at the ends of the gradient for an attribute: the style's, else the data set's, else those of 16 bits. */
export function rangeOf(
  name: string,
  style: PointCloudStyle,
  { attributes }: Pick<SceneFacts, "attributes">,
): readonly [number, number] {
  // A range is given in the unit of the first colouring.
  if (style.range && name === style.color) return style.range;
  return attributes.find((attribute) => attribute.name === name)?.range ?? [0, 65535];
}

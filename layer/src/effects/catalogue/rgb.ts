import { colouringEffect, colouringsOf, colourStatements, RGB } from "../declaration/colouring.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import { tone } from "./tone.js";

/** The colours that the scan recorded. */
export const rgb: Effect<{ name: "rgb"; words: { color: typeof RGB } }> = {
  ...colouringEffect("rgb", "the scan's own colours"),
  options: {},
  words: { color: RGB },
  colours: { shows: (_, kind) => kind === "color", toned: true },
  part(context) {
    if (!showsColour(context.pass)) return undefined;
    const toned = context.runs(tone);
    return {
      attributes: colouringsOf(context, rgb).map(({ column }) => ({
        column,
        components: 4,
        normalized: true,
      })),
      vertex: {
        color: colourStatements(context, rgb, (column) =>
          toned ? `tone(${context.attribute(column)}.rgb)` : `${context.attribute(column)}.rgb`,
        ),
      },
    };
  },
};

import { colourStatements, LEAST_SHARE, shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { showsColour } from "../part.js";

/** The colours that the scan recorded. */
export const ownColour: Effect = {
  name: "ownColour",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "share of a point's colour (thesis, 4.1)",
  wish: (scene) =>
    shareOf(scene, "own") > 0
      ? { kind: "asked", why: "the style shows the scan's own colours" }
      : { kind: "off", why: "the style shows other colours" },
  magnitude: (scene) => shareOf(scene, "own"),
  part({ plan, pass, attribute }) {
    if (!showsColour(pass)) return undefined;
    const columns = plan.colourings.filter(({ kind }) => kind === "own").map(({ column }) => column!);
    const toned = plan.active.has("tone");
    return {
      attributes: columns.map((column) => ({ column, components: 4, normalized: true })),
      vertex: {
        color: colourStatements(plan, "own", (column) =>
          toned ? `tone(${attribute(column)}.rgb)` : `${attribute(column)}.rgb`,
        ),
      },
    };
  },
};

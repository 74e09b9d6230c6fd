import { colourStatements, LEAST_SHARE, shareOf } from "../colouring.js";
import type { Effect } from "../effect.js";
import { showsColour } from "../part.js";

/** Classes by a table of colours (thesis, 4.1; ASPRS LAS 1.4 R15, table 17). */
export const classification: Effect = {
  name: "classification",
  unit: "share",
  threshold: LEAST_SHARE,
  source: "share of a point's colour (thesis, 4.1)",
  wish: (scene) =>
    shareOf(scene, "class") > 0
      ? { kind: "asked", why: "the style shows classes" }
      : { kind: "off", why: "the style does not show classes" },
  magnitude: (scene) => shareOf(scene, "class"),
  part({ plan, pass, attribute }) {
    if (!showsColour(pass)) return undefined;
    const columns = plan.colourings.filter(({ kind }) => kind === "class").map(({ column }) => column!);
    return {
      attributes: columns.map((column) => ({ column, components: 1, normalized: false })),
      uniforms: [{ name: "u_classes", type: "sampler2D", scope: "texture" }],
      vertexFunctions: "#include <classEntry>",
      vertex: { color: colourStatements(plan, "class", (column) => `classEntry(${attribute(column)}).rgb`) },
    };
  },
};

import { drawsOffscreen } from "../effect-plan.js";
import { type Part, type PartContext, showsColour } from "../part.js";

/** What every program of points begins with: the position, and what its pass writes. */
export function basePart({ plan, target, pass }: PartContext): Part {
  return {
    attributes: [{ column: "position", components: 3, normalized: false }],
    uniforms: [
      { name: "u_firstId", type: "int", scope: "node" },
      { name: "u_pickColor", type: "vec4", scope: "view" },
    ],
    varyings: [
      ...(showsColour(pass) ? [{ name: "v_color", type: "vec3" as const }] : []),
      ...(pass === "id" ? [{ name: "v_id", type: "uint" as const, flat: true }] : []),
    ],
    vertex: {
      locate: "vec4 eye = $modelView * vec4(a_position, 1.0);",
      project: "gl_Position = $projection * eye;",
      ...(showsColour(pass) && { hand: "v_color = color;" }),
      ...(pass === "id" && { hand: "v_id = uint(u_firstId + gl_VertexID) + 1u;" }),
    },
    // Cesium's pick pass puts this colour in place of the point's.
    ...(target === "cesium" && pass === "color" && { fragmentDeclarations: ["uniform vec4 u_pickColor;"] }),
    fragment: {
      ...(pass === "color" && { output: colourOutput(target === "cesium" && !drawsOffscreen(plan)) }),
      ...(pass === "depth" && { output: "out_FragColor = vec4(1.0);" }),
      ...(pass === "id" && { output: ID_OUTPUT }),
    },
  };
}

/** @param corrected whether the picture is drawn into takes colours of its own space; a quad does it otherwise */
function colourOutput(corrected: boolean): string {
  return corrected
    ? "out_FragColor = czm_gammaCorrect(vec4(v_color, 1.0));"
    : "out_FragColor = vec4(v_color, 1.0);";
}

/** One number per drawn point over all nodes, 0 for none: least significant byte in red. */
const ID_OUTPUT = "out_FragColor = vec4(uvec4(v_id, v_id >> 8u, v_id >> 16u, v_id >> 24u) & 255u) / 255.0;";

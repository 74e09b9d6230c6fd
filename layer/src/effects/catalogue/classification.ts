import { colour, entriesOf, flag, inside, type Kind, parts, shown, text } from "../../options/index.js";
import {
  ASPRS_CLASSES,
  CLASS_ENTRY,
  type ClassStyle,
  type ClassTable,
  classTexture,
  type PointClass,
} from "../declaration/classes.js";
import { colouringEffect, colouringsOf, colourStatements } from "../declaration/colouring.js";
import { type Effect, showsColour } from "../declaration/effect.js";
import { option } from "../declaration/option.js";

const pointClass = parts<PointClass>({ name: text, color: colour, show: flag });
const NUMBERS = Object.keys(ASPRS_CLASSES);

/** A table in which single classes, and parts of them, are edited. */
const table: Kind<ClassTable> = {
  valid: "an object of classes by number, 0 to 255",
  read(given, place, present = ASPRS_CLASSES) {
    const edited: Record<number, PointClass> = { ...present };
    for (const [number, edit] of entriesOf(given, undefined, place, this.valid)) {
      if (!NUMBERS.includes(number))
        place.refuse(`unknown class ${shown(number)}`, "use numbers from 0 to 255");
      if (edit === undefined) continue;
      edited[Number(number)] = pointClass.read(edit, inside(place, `.${number}`), present[Number(number)]);
    }
    return edited;
  },
};

/** Classes by a table of colours (thesis, 4.1; ASPRS LAS 1.4 R15, table 17). */
export const classification: Effect<{ name: "classification"; own: ClassStyle }> = {
  ...colouringEffect("classification", "classes"),
  options: { classes: option("STYLE_CLASSES", table, ASPRS_CLASSES) },
  colours: { shows: (_, kind) => kind === "class" },
  part(context) {
    if (!showsColour(context.pass)) return undefined;
    const columns = colouringsOf(context, classification).map(({ column }) => column);
    return {
      attributes: columns.map((column) => ({ column, components: 1, normalized: false })),
      uniforms: [{ name: "u_classes", type: "sampler2D", scope: "texture" }],
      vertexFunctions: [CLASS_ENTRY],
      vertex: {
        color: colourStatements(
          context,
          classification,
          (column) => `classEntry(${context.attribute(column)}).rgb`,
        ),
      },
    };
  },
  textures: ({ style, facts }) => [classTexture(style, facts.filter)],
};

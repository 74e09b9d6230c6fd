import type { Colouring, EffectPlan } from "./effect-plan.js";
import type { StyledAttribute } from "./facts.js";
import type { Scene } from "./scene.js";
import type { ColourBy } from "./style.js";

/** Share of colour below which a blend shows nothing: half a step of 8 bits. */
export const LEAST_SHARE = 0.5 / 255;

/** Column that the scan's own colours stand in. */
export const OWN_COLOUR = "color";

/** Where the colours of a style come from: one colouring, or two where a blend shows both. */
export function colouringsOf({ style, facts }: Scene): Colouring[] {
  const share = style.blend?.share ?? 0;
  const first = share < 1 - LEAST_SHARE ? [colouringOf(style.color, facts.attributes)] : [];
  const second = style.blend && share > LEAST_SHARE ? [colouringOf(style.blend.color, facts.attributes)] : [];
  return [...first, ...second];
}

function colouringOf(by: ColourBy, attributes: readonly StyledAttribute[]): Colouring {
  if (by === "levelOfDetail") return { kind: "level", column: undefined };
  if (by === "rgb") return { kind: "own", column: OWN_COLOUR };
  const kind = attributes.find(({ name }) => name === by)?.kind;
  if (kind === "color") return { kind: "own", column: by };
  return { kind: kind === "class" || by === "classification" ? "class" : "scalar", column: by };
}

/** Share of the colour that comes from one kind of colouring. */
export function shareOf(scene: Scene, kind: Colouring["kind"]): number {
  const colourings = colouringsOf(scene);
  const share = scene.style.blend?.share ?? 0;
  if (colourings.length === 1) return colourings[0].kind === kind ? 1 : 0;
  return (colourings[0].kind === kind ? 1 - share : 0) + (colourings[1].kind === kind ? share : 0);
}

/** Statements that give each colouring of a kind its colour, by an expression. */
export function colourStatements(
  plan: EffectPlan,
  kind: Colouring["kind"],
  expression: (column: string, index: number) => string,
): string {
  const single = plan.colourings.length === 1;
  return plan.colourings
    .map((colouring, index) =>
      colouring.kind === kind
        ? `vec3 color${single ? "" : index} = ${expression(colouring.column ?? "", index)};`
        : "",
    )
    .filter((line) => line !== "")
    .join("\n");
}

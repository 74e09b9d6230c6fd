import type { Crs } from "@groma/georef";
import type { PointAttribute } from "../sources/contract/point-attribute.js";
import type { Appearance } from "../workers/index.js";
import type { AttributeInfo } from "./attribute-info.js";

/** What the list of attributes is made from. */
export interface AttributeSources {
  readonly recorded: readonly PointAttribute[];
  /** Whether the points have colours of their own. */
  readonly hasColour: boolean;
  readonly verticalUnit: Crs["verticalUnit"];
  /** Least and greatest z, source units. */
  readonly elevations: readonly [number, number];
  /** Least and greatest height above WGS84, metres. */
  readonly heights: readonly [number, number];
  readonly appearance: Appearance | undefined;
}

const COLOURS = ["red", "green", "blue"];

/** The attributes of a data set's points: colour and heights first, then as they are recorded. */
export function attributesOf(sources: AttributeSources): AttributeInfo[] {
  const { recorded, hasColour, verticalUnit, elevations, heights, appearance } = sources;
  const colour: AttributeInfo = { name: "rgb", range: undefined, kind: "color", components: 4 };
  const scalar = { kind: "scalar", components: 1 } as const;
  return [
    ...(hasColour ? [colour] : []),
    { name: "elevation", unit: verticalUnit.name, range: elevations, ...scalar },
    { name: "ellipsoidalHeight", unit: "metre", range: heights, ...scalar },
    ...recorded
      .filter(({ name }) => !COLOURS.includes(name))
      .map((attribute) => infoOf(attribute, appearance)),
  ];
}

function infoOf(
  { name, description, unit, kind, components }: PointAttribute,
  appearance?: Appearance,
): AttributeInfo {
  return {
    ...{ name, kind, components, range: kind === "flags" ? undefined : appearance?.ranges.get(name) },
    ...(description && { label: description }),
    ...(unit !== undefined && { unit }),
  };
}

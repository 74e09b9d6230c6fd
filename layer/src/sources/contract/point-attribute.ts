/** Numeric types in which attributes are recorded. */
export type NumberType =
  | "uint8"
  | "int8"
  | "uint16"
  | "int16"
  | "uint32"
  | "int32"
  | "uint64"
  | "int64"
  | "float32"
  | "float64";

/** One attribute of the points of a data set. */
export interface PointAttribute {
  /** `red`, `green` and `blue` together are the points' own colour. */
  readonly name: string;
  /** The writer's words about it; empty where there are none. */
  readonly description: string;
  /** Unit of its values, where it is known. */
  readonly unit?: string;
  /** Whether its values are numbers, class numbers or bits. */
  readonly kind: "scalar" | "class" | "flags";
  readonly type: NumberType;
  /** Numbers of that type per point. */
  readonly components: 1 | 2 | 3;
  /** value = stored · scale + offset, per component. */
  readonly scale: readonly number[];
  readonly offset: readonly number[];
  /** The stored number that means "no value"; undefined where there is none. */
  readonly noData: number | bigint | undefined;
}

/**
 * Names that no recorded attribute may have: of columns that come from coordinates and colours, of the places
 * themselves, and of the colouring by level of detail.
 */
export const DERIVED_COLUMNS: readonly string[] = [
  ...["x", "y", "z", "position", "rgb", "elevation", "ellipsoidalHeight", "levelOfDetail"],
];

/** A name that is not taken yet: the plain one or, as `intensity 2`, with the first number that is free. It is taken then. */
export function takeName(plain: string, taken: Set<string>): string {
  let name = plain;
  for (let number = 2; taken.has(name); number++) name = `${plain} ${number}`;
  taken.add(name);
  return name;
}

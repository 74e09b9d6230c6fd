import type { PointBatch } from "../query/index.js";
import { takeName } from "../sources/contract/point-attribute.js";
import { exactValue } from "../workers/index.js";
import type { PointSelection } from "./selection.js";

/** Coordinates as text: every digit that the scale has, and no more where the scale is a decimal fraction. */
export class CoordinateText {
  readonly #scale: readonly number[];
  readonly #offset: readonly number[];
  readonly #digits: readonly (number | undefined)[];

  constructor({ scale, offset }: Pick<PointSelection["origin"], "scale" | "offset">) {
    this.#scale = scale;
    this.#offset = offset;
    this.#digits = [0, 1, 2].map((axis) => {
      const digits = Math.max(decimals(scale[axis]), decimals(offset[axis]));
      return digits <= 12 ? digits : undefined;
    });
  }

  /** One axis of a point; the number that float64 has where the scale has no end. */
  of(integer: number, axis: number): string {
    const value = integer * this.#scale[axis] + this.#offset[axis];
    const digits = this.#digits[axis];
    return digits === undefined ? String(value) : value.toFixed(digits);
  }

  /** The same as a number. */
  value(integer: number, axis: number): number {
    return integer * this.#scale[axis] + this.#offset[axis];
  }
}

/** Digits behind the point of a number, as it is written shortest. */
function decimals(value: number): number {
  const [digits, exponent = "0"] = String(value).toLowerCase().split("e");
  const behind = digits.split(".")[1]?.length ?? 0;
  return Math.max(0, behind - Number(exponent));
}

/** An attribute of the points as a column of text. */
export interface TextColumn {
  readonly name: string;
  /** Text of the value of one point; empty where it has none. */
  of(batch: PointBatch, point: number): string;
}

/**
 * The attributes of a batch but for coordinates, a column for each component.
 * @param own names that the file has besides: an attribute of that name gets a number, as `chainage 2`
 */
export function attributeColumns({ records }: PointBatch, own: readonly string[]): TextColumn[] {
  const taken = new Set(own);
  return records.attributes.flatMap(({ name, components }, index) =>
    Array.from({ length: components }, (_, component) => ({
      name: takeName(components === 1 ? name : `${name} ${component + 1}`, taken),
      of: ({ records: { attributes } }: PointBatch, point: number) => {
        const value = exactValue(attributes[index], point, component);
        return typeof value === "number" && !Number.isFinite(value) ? "" : String(value);
      },
    })),
  );
}

import type { AttributeDeclaration } from "../effects/index.js";
import type { Column } from "../workers/index.js";

/** The column that places are in; all others are those of `NodeVertices.columns`. */
export const POSITION = "position";

/**
 * What a buffer holds for each point of a node where all have the same value: the numbers stored, not the value that they
 * stand for.
 * @param column undefined where the data set has no such attribute, which then is 0
 */
export function storedConstant(components: number, column: Column | undefined): number[] {
  const { constant = [], scale = 1, offset = 0 } = column ?? {};
  // No value at all is NaN, which not every GPU can be given.
  return Array.from({ length: components }, (_, at) => ((constant[at] ?? 0) - offset) / scale || 0);
}

/** What a program reads of each point: programs with the same signature share vertex arrays. */
export interface AttributeSet {
  readonly attributes: readonly AttributeDeclaration[];
  /** The columns behind them. */
  readonly columns: readonly string[];
  readonly signature: string;
}

/** A set of attributes, with what tells it from others. */
export function attributeSet(attributes: readonly AttributeDeclaration[]): AttributeSet {
  return { attributes, columns: attributes.map(({ column }) => column), signature: signatureOf(attributes) };
}

/** What tells two sets of attributes apart. */
export function signatureOf(attributes: readonly AttributeDeclaration[]): string {
  return attributes
    .map(({ column, location, normalized }) => `${location}${normalized ? "n" : ""}${column}`)
    .join();
}

import { ComponentDatatype } from "cesium";
import type { AttributeDeclaration } from "../effects/index.js";
import type { Column, ColumnData } from "../workers/index.js";
import type { Buffer, VertexAttribute } from "./engine/cesium-private.js";

/** The column that places are in; all others are those of `NodeVertices.columns`. */
export const POSITION = "position";

/** A vertex attribute that reads a buffer of a column's numbers. */
export function bufferAttribute(
  { location, normalized, components }: AttributeDeclaration,
  vertexBuffer: Buffer,
  data: ColumnData,
): VertexAttribute {
  return {
    index: location,
    vertexBuffer,
    componentsPerAttribute: components,
    componentDatatype: datatypeOf(data),
    normalize: normalized,
  };
}

/**
 * A vertex attribute that is the same for all points of a node, as where they share one class: it takes no memory.
 * @param column undefined where the data set has no such attribute, which then is 0
 */
export function constantAttribute(
  { location, normalized, components }: AttributeDeclaration,
  column: Column | undefined,
): VertexAttribute {
  const { constant = [], scale = 1, offset = 0 } = column ?? {};
  // What the shader would read from a buffer: the number stored, not the value that it stands for.
  const stored = (value: number) => (normalized ? value / 255 : (value - offset) / scale);
  // No value at all is NaN, which not every GPU can be given.
  const value = Array.from({ length: components }, (_, at) => stored(constant[at] ?? 0) || 0);
  return { index: location, value };
}

/** What a program reads of each point: programs with the same signature share vertex arrays. */
export interface AttributeSet {
  readonly attributes: readonly AttributeDeclaration[];
  /** The columns behind them. */
  readonly columns: readonly string[];
  readonly signature: string;
}

export function attributeSet(attributes: readonly AttributeDeclaration[]): AttributeSet {
  return { attributes, columns: attributes.map(({ column }) => column), signature: signatureOf(attributes) };
}

/** What tells two sets of attributes apart. */
export function signatureOf(attributes: readonly AttributeDeclaration[]): string {
  return attributes
    .map(({ column, location, normalized }) => `${location}${normalized ? "n" : ""}${column}`)
    .join();
}

function datatypeOf(data: ColumnData): number {
  if (data instanceof Float32Array) return ComponentDatatype.FLOAT;
  if (data instanceof Uint8Array) return ComponentDatatype.UNSIGNED_BYTE;
  if (data instanceof Int8Array) return ComponentDatatype.BYTE;
  if (data instanceof Uint16Array) return ComponentDatatype.UNSIGNED_SHORT;
  if (data instanceof Int16Array) return ComponentDatatype.SHORT;
  return data instanceof Uint32Array ? ComponentDatatype.UNSIGNED_INT : ComponentDatatype.INT;
}

/** What is known of one attribute of a data set's points. */
export interface AttributeInfo {
  /** Name of its column; see `NodeVertices.columns`. */
  readonly name: string;
  /** The writer's words about it, for extra bytes that have them. */
  readonly label?: string;
  readonly unit?: string;
  /**
   * Least and greatest value: from the file's statistics, else as seen in the first node; undefined until that is here
   * and for attributes that have no order.
   */
  readonly range: readonly [number, number] | undefined;
  /** Whether its values are colours, numbers, class numbers or bits. */
  readonly kind: "color" | "scalar" | "class" | "flags";
  /** Numbers per point. */
  readonly components: 1 | 2 | 3 | 4;
}

/** One recorded value: 64-bit integers beyond 2^53 are bigint, arrays of extra bytes one number per component. */
export type RecordValue = number | bigint | readonly (number | bigint)[];

/** One point exactly as it is recorded. */
export interface PointRecord {
  /** Node, `depth-x-y-z`. */
  readonly node: string;
  /** Index of the record in the node's chunk. */
  readonly index: number;
  /** x, y, z as LAS integers. */
  readonly integers: readonly [number, number, number];
  /** x, y, z in the units of the data set's coordinate system. */
  readonly source: readonly [number, number, number];
  /**
   * All attributes by name: those of the columns as far as they are recorded, `red`, `green`, `blue` instead of a
   * colour, GPS time and extra bytes in full. Without prototype: what is not an attribute is not there.
   */
  readonly attributes: Readonly<Record<string, RecordValue>>;
}
